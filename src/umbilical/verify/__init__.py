"""The verification a sceptical engineer can run: every case, and what it found.

The cases are those of the tests; each family of them stands in a file named after its source, and what it is compared
with in :mod:`umbilical.verify.references`.
"""

from umbilical.verify.verification import FAMILIES, Verification, verify_all

__all__ = ["FAMILIES", "Verification", "verify_all"]
