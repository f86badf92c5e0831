"""The one decorator that turns a function into a compiled kernel, and where the compiled code is kept.

numba's own cache watches a kernel's own file only, so editing a kernel that another file calls would
silently run the old code. Here the cache lives in a folder named by a hash of every kernel source.
"""

from __future__ import annotations

import gc
import hashlib
import logging
import platform
from collections.abc import Callable
from functools import cache, cached_property, update_wrapper
from multiprocessing import parent_process
from pathlib import Path
from time import process_time
from typing import Any

import llvmlite
import llvmlite.binding
import numba
import numpy
from numba.core import config as numba_config
from numba.core import types
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase
from numba.core.compiler_machinery import FunctionPass, register_pass
from numba.core.typed_passes import (
    AnnotateTypes,
    NativeLowering,
    NoPythonBackend,
    NoPythonSupportedFeatureValidation,
    NopythonTypeInference,
    PreLowerStripPhis,
)
from numba.extending import lower_builtin, register_jitable, type_callable

from umbilical.inlining import lean, untyped
from umbilical.kernel_cache import folder_for, is_whole, seal
from umbilical.lowering import LowerDirectly, LowerRows

config: Any = numba_config  # its settings are made at run time, unknown to type checkers

_FLOORS_WITH_KERNELS = ("relations", "plant", "control", "engine")
_BESIDES = ("compile.py", "frames.py", "inlining.py", "lowering.py")
"""Files outside these floors that the compiled code depends on."""
_PACKAGE = Path(__file__).parent


def _fingerprint() -> str:
    """Hash of all kernel sources, of what declares their records, of versions and of flags that change the code."""
    digest = hashlib.sha256()
    besides = [_PACKAGE / name for name in _BESIDES]
    floors = [path for floor in _FLOORS_WITH_KERNELS for path in sorted((_PACKAGE / floor).rglob("*.py"))]
    for source in besides + [path for path in floors if path.parent.name != "checks"]:  # which have no kernels
        digest.update(source.relative_to(_PACKAGE).as_posix().encode())
        digest.update(source.read_bytes())
    versions = (platform.python_version(), numba.__version__, llvmlite.__version__, numpy.__version__)
    digest.update(repr((versions, bool(config.BOUNDSCHECK))).encode())
    return digest.hexdigest()[:16]


@cache
def cache_folder() -> Path:
    """Folder of the compiled kernels of exactly this source, see :mod:`umbilical.kernel_cache`."""
    return folder_for(_fingerprint())


def is_warm(loop: str = "run_dry_steps") -> bool:
    """Whether a loop has been compiled before and will load from disk; ``engine/setup.py`` knows which runs what."""
    return any(is_whole(path) for path in cache_folder().rglob(f"*.{loop}-*.nbc"))


@cache
def announce(loop: str = "run_dry_steps") -> None:
    """Say once, before a kernel of a loop is first called, that kernels are about to be compiled.

    The message is a warning of the logger ``umbilical``, which Python writes to stderr;
    ``logging.getLogger("umbilical").setLevel("ERROR")`` switches it off.
    """
    if not config.DISABLE_JIT and not is_warm(loop) and parent_process() is None and not _said:
        _said.append(loop)
        logging.getLogger("umbilical").warning(
            "compiling the kernels once, about %.0f s, longer on a busy machine; later runs load them from disk",
            expected_time(loop),
        )


_said: list[str] = []
"""The loop that was announced, for all."""


def expected_time(loop: str) -> float:
    """How long the kernels of a run will take to compile, s: a short piece of Python, times what they took of it."""
    begun = process_time()
    sorted(str(i) for i in range(_SHORT_PIECE))
    return _LOOP_TO_SHORT_PIECE[loop] * (process_time() - begun)


_SHORT_PIECE = 60_000
_LOOP_TO_SHORT_PIECE = {"run_dry_steps": 800.0, "run_steps": 1200.0, "run_held": 1200.0, "run_rope_steps": 1500.0}
"""Processor time of the one over that of the other, in a process that has compiled nothing; measured within a sixth."""


class _Whole(JITCodeLibrary):
    """The code of a kernel with that of all kernels it calls: optimised once, as a whole.

    numba optimises every function by itself and the whole twice. Loops are vectorised and not unrolled, which takes
    half the time to compile and none to run.
    """

    def _optimize_functions(self, ll_module: Any) -> None:
        ll_module.data_layout = self._codegen._data_layout

    def _optimize_final_module(self) -> None:
        options = llvmlite.binding.create_pipeline_tuning_options(speed_level=config.OPT)
        options.loop_vectorization, options.loop_unrolling = bool(config.LOOP_VECTORIZE), False
        passes = llvmlite.binding.create_pass_builder(self._codegen._tm, options)
        passes.getModulePassManager().run(self._final_module, passes)


class _Part(_Whole):
    """The code of a kernel for those that call it: shortened, and no machine code, since theirs will hold it."""

    codegen = property(lambda self: self)

    def set_env(self, name: str, environment: object) -> None:
        """Nothing: what numba would keep for Python objects has no place in a kernel."""

    def get_pointer_to_function(self, name: str) -> int:
        return 0

    def _optimize_final_module(self) -> None:
        """Only what makes it shorter, so that its callers have less to take in."""
        passes = llvmlite.binding.create_pass_builder(
            self._codegen._tm, llvmlite.binding.create_pipeline_tuning_options(speed_level=1)
        )
        simplify = passes.getFunctionPassManager()
        for function in self._final_module.functions:
            if not function.is_declaration:
                simplify.run(function, passes)

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True

    def serialize_using_object_code(self) -> Any:
        return self.serialize_using_bitcode()


class _Compiler(CompilerBase):
    """The passes of numba's that kernels need; no collection of garbage meanwhile, a tenth of the time."""

    library: type[JITCodeLibrary] = _Whole
    lowering: type[NativeLowering] = LowerDirectly

    def define_pipelines(self) -> list[Any]:
        passes = untyped(self.state, {})
        typed = (NopythonTypeInference, _ChooseLibrary, PreLowerStripPhis, AnnotateTypes)
        for one in (*typed, NoPythonSupportedFeatureValidation, self.lowering, NoPythonBackend):
            passes.add_pass(one, one.__name__)
        passes.finalize()
        self.state.metadata["library"] = self.library
        return [passes]

    def compile_extra(self, func: Any) -> Any:
        enabled = gc.isenabled()
        gc.disable()
        try:
            with lean():
                return super().compile_extra(func)
        finally:
            if enabled:
                gc.enable()


class _PartCompiler(_Compiler):
    library = _Part


class _RowCompiler(_PartCompiler):
    lowering = LowerRows


@register_pass(mutates_CFG=False, analysis_only=False)
class _ChooseLibrary(FunctionPass):
    """Where the code goes, before it is written."""

    _name = "umbilical_library"

    def __init__(self) -> None:
        FunctionPass.__init__(self)

    def run_pass(self, state: Any) -> bool:
        library = state.metadata.pop("library")
        state.library = library(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return False


class Kernel:
    """A kernel that others take in; called from Python it is compiled once more, as a function of its own."""

    def __init__(self, function: Callable[..., Any], taken_in: bool, compiler: type[_Compiler] = _PartCompiler) -> None:
        update_wrapper(self, function)
        self.py_func, self._taken_in, self._compiler = function, taken_in, compiler

    # Made when first asked for: a process that finds its loop on disk needs none of them.
    @cached_property
    def _entry(self) -> Any:
        return entry_kernel(self.py_func)

    @cached_property
    def _part(self) -> Any:
        return _compiled(self.py_func, "parts", self._compiler, forceinline=self._taken_in, no_cpython_wrapper=True)

    @cached_property
    def _numba_type_(self) -> types.Dispatcher:
        return types.Dispatcher(self._part)  # which does not keep it

    def __call__(self, *arguments: Any) -> Any:
        return self._entry(*arguments)


_COMMON = {"error_model": "numpy", "no_cfunc_wrapper": True, "_nrt": False}


def _compiled(function: Callable[..., Any], folder: str, compiler: type[_Compiler], **special: Any) -> Any:
    njit: Any = numba.njit  # its last options are not in its annotations
    before, config.CACHE_DIR = config.CACHE_DIR, str(cache_folder() / folder)
    try:
        return seal(njit(pipeline_class=compiler, cache=True, nogil=True, **_COMMON, **special)(function))
    finally:
        config.CACHE_DIR = before


def kernel(function: Callable[..., Any]) -> Any:
    """A compiled function whose code is taken into every kernel that calls it.

    Compiled when first called, kept on disk, and without the GIL while it runs. No fast-math: results must
    not depend on the compiler's mood. Division by zero gives inf or NaN, which the engine looks for, instead
    of raising inside a loop. Without numba's reference counting (three times the cost of the arithmetic), so
    a kernel that allocates does not compile.
    """
    return function if config.DISABLE_JIT else Kernel(function, taken_in=True)


def row_kernel(function: Callable[..., Any]) -> Any:
    """A kernel whose loops walk along rows, every turn at places of its own: what one writes no other reads.

    That is a promise. Where it holds, the compiler does several turns at once without looking whether rows overlap,
    which it gives up where there are many rows.
    """
    return function if config.DISABLE_JIT else Kernel(function, taken_in=True, compiler=_RowCompiler)


def rare_kernel(function: Callable[..., Any]) -> Any:
    """A kernel that stays one function in each that calls it, for what they do rarely and at several places."""
    return function if config.DISABLE_JIT else Kernel(function, taken_in=False)


def glue(function: Callable[..., Any]) -> Any:
    """A kernel that only puts others in order: its source is taken into its callers before they are compiled.

    Many large arguments then are neither passed nor compiled for once more on every floor.
    """
    return _compiled(function, "", _Compiler, inline="always")


def formula(function: Callable[..., Any]) -> Any:
    """A plain function, of floats or arrays, whose code is also taken into the kernels that call it."""
    return register_jitable(pipeline_class=_PartCompiler, forceinline=True, **_COMMON)(function)


def fma(a: float, b: float, c: float) -> float:
    """a b + c; in kernels rounded once, on every processor, in half the time of two operations."""
    return a * b + c


@type_callable(fma)
def _type_of_fma(context: Any) -> Any:
    return lambda a, b, c: types.float64


@lower_builtin(fma, types.float64, types.float64, types.float64)
def _lower_fma(context: Any, builder: Any, signature: Any, values: Any) -> Any:
    return builder.fma(*values)


def plain(kernel: Any) -> Callable[..., Any]:
    """A kernel as the Python function it was, for what is not worth compiling by itself."""
    return getattr(kernel, "py_func", kernel)


def entry_kernel(function: Callable[..., Any]) -> Any:
    """A kernel that Python calls."""
    return _compiled(function, "", _Compiler)
