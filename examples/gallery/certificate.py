"""
A rate of decay that is proved
==============================

Every condition of the proof, and what bounds the rate.
"""

import umbilical

found = umbilical.certify(umbilical.load("ringdown", {"control.law.slope_gain": 5.0}))
figure = umbilical.plot_certificate(found)
print(str(found).splitlines()[0])
