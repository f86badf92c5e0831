"""Columns of numbers in files of other programs: CSV as spreadsheets write it, and NetCDF; read, checked, converted."""

from umbilical.columns.reading import Columns, read_columns
from umbilical.columns.series import Choice, Series, series_of
from umbilical.columns.units import factor

__all__ = ["Choice", "Columns", "Series", "factor", "read_columns", "series_of"]
