#include "base/alarm.h"
#include "python/bindings.h"

namespace trunnion::python {
namespace py = pybind11;
namespace {

/// Raises an exception of the module: its text is that of the command line, its position is given
/// as attributes.
void raise(const char* name, const std::string& text, const SourceRef& where,
           const std::string& line_text) {
    const py::object type = py::module_::import("trunnion._native").attr(name);
    const py::object error = type(text);
    error.attr("path") = where.program;
    error.attr("line") = where.line;
    error.attr("column") = where.column;
    error.attr("line_text") = line_text;
    PyErr_SetObject(type.ptr(), error.ptr());
}

void translate(std::exception_ptr thrown) {
    try {
        if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& e) {
        raise("InputError", format_diagnostic(e.where, e.message, e.line_text), e.where,
              e.line_text);
    } catch (const Alarm& e) {
        raise("Alarm", format_diagnostic(e.where, e.text, e.block), e.where, e.block);
    }
}

}  // namespace

void add_errors(py::module_& m) {
    m.attr("InputError") = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
        "trunnion.InputError", "A bad file or argument: path, line, column, line_text.",
        PyExc_ValueError, nullptr));
    m.attr("Alarm") = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
        "trunnion.Alarm", "An NC alarm: path, line, column, line_text; number and run.",
        PyExc_RuntimeError, nullptr));
    py::register_exception_translator(&translate);
}

}  // namespace trunnion::python
