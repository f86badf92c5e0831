"""Columns of numbers in files of other programs: CSV as spreadsheets write it, and NetCDF; read, checked, converted."""

from umbilical.columns.reading import Columns, read_columns
from umbilical.columns.series import ColumnChoice, Series, series_of
from umbilical.columns.units import factor
from umbilical.columns.wide import Wanted, lists_of

__all__ = ["ColumnChoice", "Columns", "Series", "Wanted", "factor", "lists_of", "read_columns", "series_of"]
