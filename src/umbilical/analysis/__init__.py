"""What a run says, computed from its arrays and never from the engine."""
