"""Other tools, each in its own file and imported when it is used."""
