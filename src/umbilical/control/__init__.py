"""The controllers: from a ``Measurement`` to a ``Command``, never seeing the truth."""
