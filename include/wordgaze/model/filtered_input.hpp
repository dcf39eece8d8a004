#pragma once
#include "wordgaze/model/cell_alphabet.hpp"

namespace wordgaze::model {

/// The filter F = O~ * s(M), cell by cell, and its product with the memory's input weight, in one:
/// equations (F1)-(F2) in docs/math.md.
///
/// W_x F is a sum over the 49 cells of s[code] * (W_x's columns of that cell) O~[code]. The product
/// in brackets is a table of 49 P columns, so a frame costs 49 scaled column additions instead of
/// 49 C of them, and F is never formed. Exact for any encoder that looks at one cell at a time.
///
/// shapes   visual [C, P]   scale [P or more, N]   input_weight [G, 49 C]   table [G, 49 P]: column
/// cell * P + code
template <std::floating_point S>
struct FilteredInput {
  /// Cells [from, to) of the table, so that workers can share the work.
  static void make_table(In<S> input_weight, In<S> visual, Index from, Index to, Out<S> table) {
    const Index channels = visual.rows(), codes = visual.cols();
    for (Index c = from; c < to; ++c) {
      table.middleCols(c * codes, codes).noalias() =
          input_weight.middleCols(c * channels, channels) * visual;
    }
  }
  /// Accumulates into the gradients of cells [from, to) of the input weight and into dvisual.
  static void table_backward(In<S> input_weight, In<S> visual, In<S> dtable, Index from, Index to,
                             Out<S> dinput_weight, Out<S> dvisual) {
    const Index channels = visual.rows(), codes = visual.cols();
    for (Index c = from; c < to; ++c) {
      const auto dt = dtable.middleCols(c * codes, codes);
      dinput_weight.middleCols(c * channels, channels).noalias() += dt * visual.transpose();
      dvisual.noalias() += input_weight.middleCols(c * channels, channels).transpose() * dt;
    }
  }

  // Cells outside, frames inside: the few columns of a cell that frames ask for stay in the cache,
  // the whole table (about a megabyte) does not.

  /// product [G, N] = W_x F. Seven cells are added in one pass over the column.
  static void forward(In<S> table, const CellMatrix& cells, In<S> scale, Out<S> product) {
    const Index codes = table.cols() / grid::kViewCells;
    for (Index c = 0; c < grid::kViewCells; c += grid::kViewSize) {
      for (Index n = 0; n < cells.cols(); ++n) {
        auto y = product.col(n);
        const auto term = [&](Index k) {
          const Index code = cells(c + k, n);
          return scale(code, n) * table.col((c + k) * codes + code);
        };
        const auto row =
            (((term(0) + term(1)) + (term(2) + term(3))) + ((term(4) + term(5)) + term(6)));
        if (c == 0) {
          y = row;
        } else {
          y += row;
        }
      }
    }
  }

  /// Accumulates into dtable; overwrites dscale [P, N], summed over the cells of each code.
  static void backward(In<S> table, const CellMatrix& cells, In<S> scale, In<S> dproduct,
                       Out<S> dtable, Out<S> dscale) {
    const Index codes = table.cols() / grid::kViewCells;
    dscale.setZero();
    for (Index c = 0; c < grid::kViewCells; ++c) {
      for (Index n = 0; n < cells.cols(); ++n) {
        const auto dy = dproduct.col(n);
        const Index code = cells(c, n), column = c * codes + code;
        dscale(code, n) += table.col(column).dot(dy);
        dtable.col(column) += scale(code, n) * dy;
      }
    }
  }
};

}  // namespace wordgaze::model
