#include "interpreter/dialect.h"

namespace trunnion::interpreter {

Dialect fanuc_dialect(ControlGeneration generation) {
    Dialect d;
    d.generation = generation;
    if (generation == ControlGeneration::fanuc_16i) {
        d.macro_call_levels = 4;
        d.subprogram_levels = 4;
        d.total_levels = 8;
    }
    d.has_98000 = d.has_if_blocks = generation != ControlGeneration::fanuc_16i;
    return d;
}

Dialect hurco_dialect() {
    Dialect d;
    d.family = DialectFamily::hurco;
    return d;
}

}  // namespace trunnion::interpreter
