"""What the balls are good for: the linear systems to hold them against, tuned absorbers and free decay."""
