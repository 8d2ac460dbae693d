"""The kinds of output of `rockshape synth`, a file each, and the arguments that they share."""
