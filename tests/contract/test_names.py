"""The public surface: what is exported exists, is documented, and importing it is cheap."""

from __future__ import annotations

import inspect
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest

import umbilical

NAMES = {
    "Certificate",
    "Command",
    "Comparison",
    "Controller",
    "Episode",
    "Measurement",
    "Run",
    "Scenario",
    "Status",
    "Study",
    "StudyResult",
    "certify",
    "compare",
    "design",
    "load",
    "load_operation",
    "load_study",
    "lower",
    "margins",
    "open_run",
    "open_study",
    "operate",
    "plot_cable",
    "plot_certificate",
    "plot_design",
    "plot_energy",
    "plot_lowering",
    "plot_margins",
    "plot_motors",
    "plot_observers",
    "plot_operability",
    "plot_overview",
    "plot_positions",
    "plot_study",
    "plot_tip",
    "plot_weather",
    "plot_winch",
    "preset_names",
    "show",
    "simulate",
    "sweep",
    "to_c",
    "to_control",
    "to_fmu",
    "tune",
}


def test_the_names_are_these():
    assert set(umbilical.__all__) == NAMES
    assert {*umbilical.__all__, "__version__"} == set(dir(umbilical))


@pytest.mark.parametrize("name", umbilical.__all__)
def test_a_name_leads_somewhere_and_explains_itself(name):
    assert inspect.getdoc(getattr(umbilical, name))


def test_no_module_has_the_name_of_a_function():
    # Importing `umbilical.margins` as a module would set that attribute, in place of the function.
    modules = {module.name for module in pkgutil.iter_modules(umbilical.__path__)}
    assert {"stability", "synthesis", "run"} <= modules
    assert sorted(modules & NAMES) == []


def test_a_misspelt_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="simulat"):
        umbilical.simulat  # noqa: B018


def test_importing_the_package_imports_next_to_nothing():
    script = "import sys, umbilical; raise SystemExit(any(m in sys.modules for m in ('numpy', 'pydantic', 'numba')))"
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0


def test_a_report_shows_itself_in_one_line():
    from umbilical import certify, load, margins

    for found in (margins(load("paper"), lengths=[450.0]), certify(load("paper", {"duration": 1.0}))):
        assert len(repr(found)) < 200
        assert "paper: " in repr(found)
        line, _, rest = found._repr_html_().partition("</summary>")
        assert line.startswith("<details><summary><b>paper: ")
        assert len(line) < 300
        assert len(rest) < 10_000


def test_doctor_lists_what_the_extras_install():
    import tomllib
    from pathlib import Path

    from umbilical.cli.doctor import PARTNERS

    project = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text())["project"]
    extras = {extra: set(map(_package, texts)) for extra, texts in project["optional-dependencies"].items()}
    ours = {"test", "docs", "dev"}
    assert set(PARTNERS) <= set.union(*extras.values())
    assert set.union(*(names for extra, names in extras.items() if extra not in ours)) <= set(PARTNERS)


def _package(requirement: str) -> str:
    return requirement.partition(">")[0].partition("[")[0]


def test_functions_and_classes_that_docstrings_name_are_where_they_say():
    """``:func:`name``` is of the same file or imported there; a whole path ends in a file, or a package's front."""
    source = Path(umbilical.__file__).parent
    for file in source.rglob("*.py"):
        for name in re.findall(r":(?:func|class):`~?([\w.]+)`", file.read_text()):
            *place, last = name.split(".")
            whole = [source.parent.joinpath(*place[:n]) for n in range(len(place), 0, -1)]
            homes = [home for path in whole for home in (path.with_suffix(".py"), path / "__init__.py")]
            home = next((home for home in homes if place[:1] == ["umbilical"] and home.exists()), file)
            named = rf"(def|class) {last}\b|\b{last}( as \w+)?,? *(\n|$|,|\))|\"{last}\""
            assert re.search(named, home.read_text()), f"{file.name} names {name}"
