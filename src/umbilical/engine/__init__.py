"""measure -> decide -> actuate -> advance, over and over: a scenario becomes a run."""
