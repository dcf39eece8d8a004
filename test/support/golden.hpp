#pragma once
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "wordgaze/core/require.hpp"
#include "wordgaze/core/types.hpp"

/// Golden data: results of another implementation, in test/data.
namespace wordgaze::test {

using Json = nlohmann::json;

/// A file of test/data.
inline Json golden(const std::string& name) {
  std::ifstream file(WORDGAZE_TEST_DATA "/" + name);
  require(file.good(), "no golden data '{}'", name);
  return Json::parse(file);
}

/// Nested lists of one row each, or a plain list, as a matrix of this size.
inline Matrix<double> matrix(const Json& json, Index rows, Index columns) {
  Matrix<double> m(rows, columns);
  const auto expect = [&](const Json& list, Index size) {
    require(list.size() == static_cast<std::size_t>(size), "golden data: {} values, expected {}",
            list.size(), size);
  };
  if (columns == 1 && json.at(0).is_number()) {
    expect(json, rows);
    for (Index r = 0; r < rows; ++r) m(r, 0) = json[static_cast<std::size_t>(r)];
    return m;
  }
  expect(json, rows);
  for (Index r = 0; r < rows; ++r) {
    const Json& row = json[static_cast<std::size_t>(r)];
    expect(row, columns);
    for (Index c = 0; c < columns; ++c) m(r, c) = row[static_cast<std::size_t>(c)];
  }
  return m;
}
/// A plain list as a column.
inline Matrix<double> column(const Json& json) {
  return matrix(json, static_cast<Index>(json.size()), 1);
}

/// Largest |ours - theirs| / max(|theirs|, 1e-3): relative, but for entries next to zero. NaN,
/// which is below no tolerance, where an entry is not finite on either side.
inline double relative_error(const Eigen::Ref<const Matrix<double>>& ours,
                             const Eigen::Ref<const Matrix<double>>& theirs) {
  require(ours.rows() == theirs.rows() && ours.cols() == theirs.cols(),
          "{}x{} numbers against {}x{}", ours.rows(), ours.cols(), theirs.rows(), theirs.cols());
  return ((ours - theirs).array().abs() / theirs.array().abs().max(1e-3))
      .maxCoeff<Eigen::PropagateNaN>();
}

}  // namespace wordgaze::test
