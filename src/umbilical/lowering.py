"""How the variables of a kernel become values of LLVM: directly, where numba would keep them in memory.

numba stores whatever is used in more than one block, reads what was there before, and writes zeros when it is done
with it, so that it can count references. Kernels count none (``compile.py``), and for a tuple of a hundred numbers
each of these is a hundred instructions that LLVM has to take out again.
"""

from __future__ import annotations

from collections import Counter
from typing import Any

from llvmlite import ir as llvm
from numba.core import ir, types
from numba.core.analysis import compute_cfg_from_blocks, compute_use_defs
from numba.core.compiler_machinery import register_pass
from numba.core.lowering import Lower
from numba.core.typed_passes import NativeLowering


class _Lower(Lower):
    """A variable that is assigned once, on every way to its uses, is the value itself; others stay in memory."""

    def _find_singly_assigned_variable(self) -> None:
        self._blk_local_varmap: dict[str, Any] = {}
        flow, found = compute_cfg_from_blocks(self.blocks), compute_use_defs(self.blocks)
        assigned = Counter(step.target.name for block in self.blocks.values() for step in block.find_insts(ir.Assign))
        once = {name: at for at, names in found.defmap.items() for name in names if assigned[name] == 1}
        before = flow.dominators()
        for at, names in found.usemap.items():  # of the block without what it assigns first
            for name in names & once.keys():
                if once[name] == at or once[name] not in before.get(at, ()):
                    del once[name]
        self._singly_assigned_vars, self._order = set(once), list(flow.topo_order())

    def lower_function_body(self) -> Any:
        """Lower every block after those that come before it on every way."""
        for label in self._order:
            self.blkmap[label] = self.function.append_basic_block(f"B{label}")
        self.pre_lower()
        tail = self.builder.basic_block
        for label in self._order:
            self.builder.position_at_end(self.blkmap[label])
            self.lower_block(self.blocks[label])
        self.post_lower()
        return tail

    def lower_assign(self, ty: Any, inst: Any) -> Any:
        """A function is called by its name; numba would note an address besides, which no file keeps."""
        return self.context.get_dummy_value() if isinstance(ty, types.Dispatcher) else super().lower_assign(ty, inst)

    def storevar(self, value: Any, name: str, argidx: int | None = None) -> None:
        """Keep a value under a name; there is nothing to release."""
        if name in self._singly_assigned_vars:
            self._blk_local_varmap[name] = value
        else:
            self.builder.store(value, self.getvar(name))

    def delvar(self, name: str) -> None:
        """Nothing: no references are counted."""


class _Distinct(llvm.MDValue):
    """A piece of metadata that is no other's equal, as LLVM asks of what names a loop."""

    def descr(self, buf: Any) -> None:
        super().descr(buf)
        buf[-2] = f"distinct {buf[-2]}"


class _LowerRows(_Lower):
    """Tells LLVM that no turn of a loop reads what another writes, so that it need not find out: see ``row_kernel``."""

    def lower_function_body(self) -> Any:
        self._places = self._metadata()
        tail = super().lower_function_body()
        for block in self.function.blocks:
            for step in block.instructions:
                of_array = isinstance(step, (llvm.instructions.LoadInstr, llvm.instructions.StoreInstr))
                if of_array and not isinstance(step.operands[-1], llvm.instructions.AllocaInstr):
                    step.set_metadata("llvm.access.group", self._places)
        return tail

    def lower_inst(self, inst: Any) -> None:
        super().lower_inst(inst)
        if isinstance(inst, ir.Jump) and self.blkmap[inst.target].is_terminated:  # back to the head of a loop
            loop = self._metadata()
            independent = self.module.add_metadata(["llvm.loop.parallel_accesses", self._places])
            # Eight numbers fill the widest vectors there are; LLVM by itself takes half of those, which costs a fifth.
            width = self.module.add_metadata(["llvm.loop.vectorize.width", llvm.Constant(llvm.IntType(32), 8)])
            loop.operands = (loop, independent, width)
            end: Any = self.builder.block
            end.terminator.set_metadata("llvm.loop", loop)

    def _metadata(self) -> _Distinct:
        return _Distinct(self.module, (), name=str(len(self.module.metadata)))


@register_pass(mutates_CFG=True, analysis_only=False)
class LowerDirectly(NativeLowering):
    """numba's pass with that class."""

    _name = "umbilical_lowering"
    lowering_class: Any = _Lower


@register_pass(mutates_CFG=True, analysis_only=False)
class LowerRows(NativeLowering):
    """The same for kernels along rows."""

    _name = "umbilical_lowering_rows"
    lowering_class: Any = _LowerRows
