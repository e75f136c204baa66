// The module trunnion._native; scripts import python/trunnion/__init__.py.
#include "python/bindings.h"

namespace trunnion::python {
namespace {

void fill(pybind11::module_& m) {
    m.doc() = "the compiled half of trunnion";
    m.attr("version") = TRUNNION_VERSION;
    add_errors(m);
    add_setups(m);
    add_readings(m);
    add_runs(m);
    add_fits(m);
    add_comparisons(m);
}

}  // namespace
}  // namespace trunnion::python

PYBIND11_MODULE(_native, m) {
    trunnion::python::fill(m);
}
