"""Which gains are safe, and which are best for given thrusters: what needs the engine and its judgement together."""
