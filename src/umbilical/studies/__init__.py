"""Studies: what is learnt by running scenarios and comparing."""
