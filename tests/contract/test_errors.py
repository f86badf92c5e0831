"""The tree of errors: one root, each with its exit code, drawn in the docstring as it is."""

from __future__ import annotations

import re

from umbilical import errors
from umbilical.errors import Problem, ScenarioError, UmbilicalError

FAMILY = [kind for kind in vars(errors).values() if isinstance(kind, type) and issubclass(kind, UmbilicalError)]


def test_the_tree_in_the_docstring_is_the_tree():
    drawn = dict(re.findall(r"── (\w+).*exit code (\d+)", errors.__doc__ or ""))
    assert drawn == {kind.__name__: str(kind.exit_code) for kind in FAMILY if kind is not UmbilicalError}


def test_a_scenario_error_says_everything_about_every_problem():
    problems = [Problem(f"key{k}", f"value{k}", f"bound{k}", f"reason{k}", f"fix{k}") for k in (1, 2)]
    text = str(ScenarioError(problems, "my.toml"))
    assert text.startswith("my.toml: 2 problems\n")
    for problem in problems:
        for part in (problem.key, problem.value, problem.bound, problem.reason, problem.fix):
            assert part in text


def test_one_problem_is_not_called_problems():
    assert str(ScenarioError([Problem("a", "b", "c", "d", "e")])).startswith("scenario: 1 problem\n")
