"""Hold the measures of `rockshape` to rocks whose shape `synth` knows, and pass a verdict.

The data flow one way: suite → work units → matched records → scores → gates → report.
"""
