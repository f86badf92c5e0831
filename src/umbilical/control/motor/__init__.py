"""The loop inside each motor: from a demand on |w| w to a voltage."""
