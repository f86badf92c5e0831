"""What results say: the verdict of each, its text and its data, as everybody can call them and commands print them."""
