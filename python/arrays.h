// Values as numpy arrays; each array owns its data.
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <vector>

#include "python/csv_columns.h"

namespace trunnion::python {

pybind11::array_t<double> array_of(const std::vector<double>& values);
/// Rows and columns as in the matrix.
pybind11::array_t<double> array_of(const Eigen::MatrixXd& matrix);
/// Dictionary from column names to arrays, in order; columns of words are lists.
pybind11::dict dict_of(const CsvColumns& table);

}  // namespace trunnion::python
