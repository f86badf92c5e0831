"""Design of gains: search on the linear loop against demanded margins, then one simulation."""
