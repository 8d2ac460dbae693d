"""Valid small files of every format, a module a kind of file: format's name, suffix, content."""
