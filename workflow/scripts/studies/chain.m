% Results of the program CC by Weidemann et al. for two sectors. For each in-phase resonant response, this script writes its
% frequency, the amplitudes of sector and absorber over the clearance, its stability by their slow flow, and measures of
% the motion that their time stepping reaches from their initial conditions, as in their test of practical stability.
%
%   octave chain.m FOLDER_OF_CC FILE.csv
source_folder = argv(){1};
for name = {'system', 'analytics', 'integrator', 'postprocessing'}
    addpath(fullfile(source_folder, name{1}));
end
function angle = wrapToPi(angle)  % in MATLAB, part of a toolbox
    angle = mod(angle + pi, 2 * pi) - pi;
end
run(fullfile(source_folder, 'system', 'InitStructs.m'));
[sys.N_s, sys.kappa_c, sys.epsilon_a, sys.D, sys.Gamma_Scale, sys.eN] = deal(2, 0.01, 0.02, 1e-3, 0.3, 0.8);
exc.type = 'harmonic';
exc.k = 0;
[sys, exc] = BuildSystem(sys, exc, 'tuned');
rho = (2 / pi) * (1 - sys.eN) / (1 + sys.eN);
xi = linspace(1.001 * rho / sqrt(1 + rho^2), 5, 200001);
[TRANSIENT, WATCHED] = deal(600, 100);  % forcing periods
file = fopen(argv(){2}, 'w');
fprintf(file, 'r,xi,theta,stable,impacts_per_period,spread,theta_simulated,leans\n');
for r = [0.980, 0.985, 0.9875, 0.9885, 0.990, 0.992]
    exc.harmonic.r = r;
    level = AllSectorsFRS(xi, r, sys, exc) - sys.Gamma_Scale;
    for k = find(level(1:end-1) .* level(2:end) < 0)
        at = interp1(level(k:k+1), xi(k:k+1), 0);
        theta = (1 + sqrt((1 + rho^2) * at^2 - rho^2)) / (1 + rho^2);
        stable = SlowFlowStability('GSR', sys, exc, at, r, 'tuned');
        run_of = sol;
        run_of.N_Tau = WATCHED;
        [run_of.q0, run_of.u0, run_of.qa0, run_of.ua0] = GSRInititalConditions(at * sys.Gamma(1), sys, exc);
        run_of = ConfigureIntegrator(run_of, sys, exc, 'no change', false, 'tuned');
        run_of.NP_trans = run_of.N_P * TRANSIENT;
        [eta, places, ~, speeds, ~] = MoreauIntegration(sys, exc, run_of, 'tuned');
        [heights, spreads] = MeanAmplitude(sys.Phi * eta(:, 2:end), run_of.N_Sample);
        impacts = CountImpacts(speeds, run_of.N_Tau, 'average');
        reach = (max(places(1, :)) - min(places(1, :))) / 2 / sys.Gamma(1);
        % The speeds of the first absorber to the right and to the left differ if its flights are asymmetric.
        right = mean(speeds(1, speeds(1, :) > 0));
        left = -mean(speeds(1, speeds(1, :) < 0));
        fprintf(file, '%g,%.10g,%.10g,%d,%.6g,%.3g,%.8g,%.6g\n', r, at, theta, stable, min(impacts), ...
            max(spreads ./ heights), reach, (right - left) / (right + left));
        fflush(file);
    end
end
fclose(file);
