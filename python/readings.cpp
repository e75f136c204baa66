#include "records/readings.h"

#include <pybind11/stl.h>

#include "base/read_file.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/loaded_setup.h"

namespace trunnion::python {
namespace py = pybind11;
namespace {

records::ReadingTable parse(const std::string& text, const std::string& path,
                            const LoadedSetup& setup) {
    std::vector<std::string> notes;
    return records::parse_readings(text, path, notes, setup.setup.machine.chain.names());
}

/// Several files are joined in the given order, as in the commands.
records::ReadingTable load(const std::vector<std::string>& paths, const LoadedSetup& setup) {
    if (paths.empty()) throw InputError("no file of readings is named");
    std::vector<records::ReadingTable> tables;
    for (const std::string& path : paths) tables.push_back(parse(read_file(path), path, setup));
    return records::join_readings(std::move(tables));
}

/// The head lines, including that of the sides.
std::map<std::string, std::string> comment(const records::ReadingTable& table) {
    auto lines = table.comment;
    const std::string sides = records::format_sides(table.axes, table.side_before, table.names);
    if (!sides.empty()) lines["side"] = sides;
    return lines;
}

py::dict columns(const records::ReadingTable& table) {
    CsvColumns columns({"test", "device", "feature", "mode", "session", "instrument", "source"});
    columns.add(records::format_readings(table));
    return dict_of(columns);
}

}  // namespace

void add_readings(py::module_& m) {
    py::class_<records::ReadingTable>(m, "Readings")
        .def_readonly("path", &records::ReadingTable::path)
        .def_property_readonly("comment", &comment)
        .def("__len__", [](const records::ReadingTable& t) { return t.rows.size(); })
        .def("csv", &records::format_readings)
        .def("columns", &columns);
    m.def("parse_readings", &parse, WithoutLock());
    m.def("load_readings", &load, WithoutLock());
}

}  // namespace trunnion::python
