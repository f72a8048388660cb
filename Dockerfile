# The environment of environment.lock, set up and compiled, with the pipeline in it:
#   docker build --tag vibroimpact .
#   docker run --volume "$PWD/results:/home/vibroimpact/pipeline/results" vibroimpact make figures
FROM debian:trixie-slim AS system
RUN apt-get update \
    && apt-get install --yes --no-install-recommends ca-certificates git make python3-venv \
    && rm -rf /var/lib/apt/lists/*
RUN useradd --create-home vibroimpact
USER vibroimpact
RUN mkdir /home/vibroimpact/pipeline
WORKDIR /home/vibroimpact/pipeline

FROM system
COPY --chown=vibroimpact . .
RUN make set-up && rm -rf .cache/pip .cache/uv && mkdir results
ENV PATH=/home/vibroimpact/pipeline/.venv/bin:$PATH
CMD ["make", "figures"]
