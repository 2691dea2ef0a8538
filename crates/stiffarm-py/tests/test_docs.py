"""Whatever is public says what it is, and the pages are built without a warning."""

import importlib
import inspect
import os
import subprocess
import sys
from pathlib import Path

import pytest
import stiffarm

MODULES = ["stiffarm", "stiffarm.plot", "stiffarm.cluster", "stiffarm.types"]
SCRIPT = Path(__file__).resolve().parents[3] / "scripts" / "docs"


def public(module):
    """Names that a module offers: those it lists, else those it makes."""
    names = getattr(module, "__all__", None)
    return names or [name for name, value in vars(module).items() if name[0] != "_" and getattr(value, "__module__", "") == module.__name__]


@pytest.mark.parametrize("name", MODULES)
def test_every_public_name_says_what_it_is(name):
    module = importlib.import_module(name)
    assert module.__doc__ and public(module)
    silent = []
    for each in public(module):
        value = getattr(module, each)
        if not (inspect.isclass(value) or callable(value)):
            continue
        # Where nothing is said, that of the base is inherited: it does not say what this one is.
        if not (value.__dict__.get("__doc__") if inspect.isclass(value) else value.__doc__):
            silent.append(each)
        for part, method in vars(value).items() if inspect.isclass(value) else ():
            # What a record is made of says the line above or below it; what every class has is known.
            asks = callable(method) or isinstance(method, (property, staticmethod, classmethod)) or inspect.isgetsetdescriptor(method)
            if part[0] != "_" and asks and not inspect.getdoc(getattr(value, part)):
                silent.append(f"{each}.{part}")
    assert not silent, silent


def test_options_that_are_keywords_are_explained():
    for function in (stiffarm.rank, stiffarm.place, stiffarm.map, stiffarm.study, stiffarm.compliance, stiffarm.identify, stiffarm.measure, stiffarm.modes, stiffarm.chatter, stiffarm.calibrate, stiffarm.verify):
        for keyword in inspect.signature(function).parameters:
            assert f"{keyword} : " in function.__doc__, (function.__name__, keyword)


def test_the_pages_are_built_without_a_warning(tmp_path):
    environment = {**os.environ, "PYTHON": sys.executable}
    done = subprocess.run([SCRIPT, "--python", tmp_path], capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stderr[-3000:]
    pages = {str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*.html")}
    assert pages == {"index.html", "stiffarm.html", *(f"{name.replace('.', '/')}.html" for name in MODULES[1:])}
    text = (tmp_path / "stiffarm.html").read_text()
    assert all(f'id="{name}"' in text for name in stiffarm.__all__ if name != "__version__")
