"""The reference: the same motion in ball arithmetic, written independently of the engine that it judges."""
