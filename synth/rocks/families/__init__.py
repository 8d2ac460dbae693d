"""The package's rock families, one record a file; `synth.spec.rocks` lists their names."""
