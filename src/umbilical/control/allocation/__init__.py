"""From one wanted thrust to a demand on |w| w of each motor."""
