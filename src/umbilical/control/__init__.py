"""The controllers: from a :class:`Measurement` to a :class:`Command`, never seeing the truth."""
