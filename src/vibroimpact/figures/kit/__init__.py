"""What all figures share: style, tables, what a picture shows, files."""
