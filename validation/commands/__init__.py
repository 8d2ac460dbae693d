"""Actions of `rockshape validate`, imported when one is asked for."""
