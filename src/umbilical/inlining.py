"""What numba does to a kernel before it knows any type, and only what a kernel needs of it.

numba's inliner copies the IR of a function twice before it takes it in, though nobody else has it; it takes in what
is behind a condition that is a constant of the caller, and looks at the condition afterwards; and after every pass it
works out how long each variable lives, which matters to generators and where references are counted.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from inspect import signature
from typing import Any

from numba.core import ir, postproc, transforms
from numba.core.compiler_machinery import FunctionPass, PassManager, register_pass
from numba.core.inline_closurecall import InlineWorker
from numba.core.ir_utils import get_definition, guard
from numba.core.types.functions import BaseFunction
from numba.core.untyped_passes import (
    DeadBranchPrune,
    FixupArgs,
    GenericRewrites,
    InlineInlinables,
    ReconstructSSA,
    RewriteSemanticConstants,
    TranslateByteCode,
)


def untyped(state: Any, constants: dict[str, Any]) -> Any:
    """The passes before types are known; ``constants``: values of arguments that the caller names."""
    state.constants = constants
    names = [TranslateByteCode, FixupArgs, _NameConstants, RewriteSemanticConstants, DeadBranchPrune, GenericRewrites]
    passes = PassManager("umbilical")
    for one in (*names, _TakeIn, *([ReconstructSSA] if state.flags.enable_ssa else ())):
        passes.add_pass(one, one.__name__)
    passes.finalize()
    return passes


@register_pass(mutates_CFG=False, analysis_only=False)
class _NameConstants(FunctionPass):
    """Arguments with known values become constants, so that the next pass takes out what they rule out."""

    _name = "umbilical_constants"

    def __init__(self) -> None:
        FunctionPass.__init__(self)

    def run_pass(self, state: Any) -> bool:
        for step in (step for block in state.func_ir.blocks.values() for step in block.find_insts(ir.Assign)):
            argument = step.value
            if isinstance(argument, ir.Arg) and argument.name in state.constants:
                step.value = ir.Const(state.constants[argument.name], step.loc)
                definitions = state.func_ir._definitions[step.target.name]
                definitions[definitions.index(argument)] = step.value
        return True


@register_pass(mutates_CFG=True, analysis_only=False)
class _TakeIn(InlineInlinables):
    """numba's pass with a worker that does less."""

    _name = "umbilical_inlining"

    def _do_work(self, state: Any, work_list: Any, block: Any, i: int, expr: Any, inline_worker: Any) -> Any:
        worker = _Worker(state.typingctx, state.targetctx, state.locals, state.pipeline, state.flags)
        return super()._do_work(state, work_list, block, i, expr, worker)


class _Worker(InlineWorker):
    """For one call: the IR that it takes in is made for this one, with the constants of its arguments."""

    def inline_function(self, caller_ir: Any, block: Any, i: int, function: Any, arg_typs: Any = None) -> Any:
        call = block.body[i].value
        given = signature(function).bind(*call.args, **dict(call.kws)).arguments
        found = {name: guard(get_definition, caller_ir, variable) for name, variable in given.items()}
        named = {name: it.value for name, it in found.items() if isinstance(it, (ir.Const, ir.Global))}
        flags = {name: value for name, value in named.items() if isinstance(value, bool)}
        self._compiler_pipeline = partial(untyped, constants=flags)
        return super().inline_function(caller_ir, block, i, function, arg_typs)

    def inline_ir(self, *arguments: Any, **special: Any) -> Any:
        with _instead(ir.Block, "__deepcopy__", _itself):
            return super().inline_ir(*arguments, **special)


@contextmanager
def lean() -> Iterator[None]:
    """Let numba leave out copies of scopes, the lives of variables, and types that it has found before.

    For use under numba's compiler lock.
    """
    if "__deepcopy__" in vars(ir.Scope):  # a kernel that is compiled for another
        yield
        return
    with ExitStack() as stack:
        stack.enter_context(_instead(ir.Scope, "__deepcopy__", _itself))
        stack.enter_context(_instead(postproc.PostProcessor, "run", _process))
        stack.enter_context(_instead(BaseFunction, "get_call_type", _remembered(BaseFunction.get_call_type)))
        yield


@contextmanager
def _instead(owner: Any, name: str, function: Callable[..., Any]) -> Iterator[None]:
    before = vars(owner).get(name)
    setattr(owner, name, function)
    try:
        yield
    finally:
        if before is None:
            delattr(owner, name)
        else:
            setattr(owner, name, before)


def _itself(something: Any, memo: Any) -> Any:
    """The copy of what is not copied: blocks share the scope of the function they are taken into."""
    return something


_process_fully = postproc.PostProcessor.run


def _process(self: Any, emit_dels: bool = False, extend_lifetimes: bool = False) -> None:
    """As numba's, but for the lives of variables, which are worked out when somebody asks."""
    if emit_dels or self.func_ir.is_generator:  # not of ours, but of numba's that ours call
        _process_fully(self, emit_dels, extend_lifetimes)
        return
    self.func_ir.blocks = transforms.canonicalize_cfg(self.func_ir.blocks)
    self.func_ir.variable_lifetime = postproc.VariableLifetime(self.func_ir.blocks)
    self.func_ir.generator_info = None


def _remembered(look_up: Callable[..., Any]) -> Callable[..., Any]:
    """numba looks for the type of ``a * b`` through all that could multiply, a thousand times in a loop of floats."""
    known: dict[Any, Any] = {}

    def get_call_type(self: Any, context: Any, args: Any, kws: Any) -> Any:
        if kws or getattr(self.typing_key, "__module__", "") != "_operator":
            return look_up(self, context, args, kws)
        if (self, args) not in known:
            known[self, args] = look_up(self, context, args, kws)
        return known[self, args]

    return get_call_type
