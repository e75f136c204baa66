#include "python/arrays.h"

#include <pybind11/stl.h>

#include <algorithm>

namespace trunnion::python {
namespace py = pybind11;

py::array_t<double> array_of(const std::vector<double>& values) {
    return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::array_t<double> array_of(const Eigen::MatrixXd& matrix) {
    py::array_t<double> out({matrix.rows(), matrix.cols()});
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        for (Eigen::Index j = 0; j < matrix.cols(); ++j) out.mutable_at(i, j) = matrix(i, j);
    return out;
}

py::dict dict_of(const CsvColumns& table) {
    py::dict out;
    for (const CsvColumn& column : table.columns()) {
        const py::object values =
            column.words ? py::object(py::cast(column.word)) : py::object(array_of(column.number));
        out[py::str(column.name)] = values;
    }
    return out;
}

}  // namespace trunnion::python
