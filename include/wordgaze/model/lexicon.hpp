#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>

#include "wordgaze/core/types.hpp"
#include "wordgaze/grid/cell.hpp"
#include "wordgaze/model/config.hpp"
#include "wordgaze/model/design.hpp"

namespace wordgaze::model {

/// What a word says of the things that can be seen; equations (A8)-(A11) in docs/math.md.
///
/// The scores of a word on objects are taken apart into what depends on the type and what depends on
/// the color; what is left, and scores on what is no object, is not the word's to say. As the gaze
/// focuses, a word keeps the attribute of which it says more, or says nothing. So "red" cannot learn
/// to avoid balls where red balls are never named. And a word scores nowhere by how well it could be
/// matched: what matches less is not in view.
///
/// shapes   raw [codes, V], scores [codes + 1, V]: the last row is nowhere
template <std::floating_point S>
struct Lexicon {
  static constexpr int kAttributes = 2;  ///< type, color

  struct Tables {
    std::array<Matrix<S>, kAttributes> projector;  // [codes, codes] onto what an attribute says
    std::array<Matrix<S>, kAttributes> effect;     // [codes, V] of the raw scores
    Matrix<S> share;                               ///< [kAttributes, V] how much of it counts
    Eigen::Array<Index, Eigen::Dynamic, 1> best;   ///< [V] the code that matches a word best
    Index objects = 0;                             ///< codes that are objects
  };

  static void resize(const Design& d, Tables& t) {
    const CellAlphabet& codes = d.alphabet;
    t.share.setOnes(kAttributes, babyai::kVocabularySize);
    t.best.setZero(babyai::kVocabularySize);
    t.objects = count(codes, [](const auto&) { return true; });
    for (int a = 0; a < kAttributes; ++a) {
      t.projector[a].setZero(codes.size(), codes.size());
      t.effect[a].setZero(codes.size(), babyai::kVocabularySize);
      for (int i = 0; i < codes.size(); ++i) {
        if (!is_object(codes[i])) continue;
        const auto alike = [&](const CellAlphabet::Code& other) {
          return a == 0 ? other.type == codes[i].type : other.color == codes[i].color;
        };
        const auto share = static_cast<S>(1.0 / static_cast<double>(count(codes, alike)));
        for (int j = 0; j < codes.size(); ++j) {
          if (!is_object(codes[j])) continue;
          t.projector[a](i, j) =
              (alike(codes[j]) ? share : S(0)) - S(1) / static_cast<S>(t.objects);
        }
      }
    }
  }

  /// `focus` in [0, 1]: how far words have chosen.
  static void forward(const Config& c, S focus, In<S> raw, Tables& t, Out<S> scores) {
    for (int a = 0; a < kAttributes; ++a) t.effect[a].noalias() = t.projector[a] * raw;
    choose(c, focus, t);
    const Index codes = raw.rows();
    auto spoken = scores.topRows(codes);
    spoken = t.effect[0] * t.share.row(0).asDiagonal();
    spoken += t.effect[1] * t.share.row(1).asDiagonal();
    for (Index v = 0; v < raw.cols(); ++v) {
      scores(codes, v) = static_cast<S>(c.nowhere) * spoken.col(v).maxCoeff(&t.best(v));
    }
  }
  /// From the gradient of the scores to that of raw, in the place of its first rows. The choice of
  /// an attribute is not differentiated.
  static void backward(const Config& c, const Tables& t, Out<S> dscores) {
    const Index codes = t.projector[0].rows();
    for (Index v = 0; v < dscores.cols(); ++v) {
      dscores(t.best(v), v) += static_cast<S>(c.nowhere) * dscores(codes, v);
    }
    auto dspoken = dscores.topRows(codes);
    // Projectors are symmetric.
    const Matrix<S> type = dspoken * t.share.row(0).asDiagonal();
    const Matrix<S> color = dspoken * t.share.row(1).asDiagonal();
    dspoken.noalias() = t.projector[0] * type;
    dspoken.noalias() += t.projector[1] * color;
  }

  /// What words tell apart.
  static bool is_object(const CellAlphabet::Code& code) {
    const auto type = static_cast<grid::Type>(code.type);
    return type >= grid::Type::door && type <= grid::Type::lava;
  }

 private:
  template <class Counts>
  static Index count(const CellAlphabet& codes, Counts&& counts) {
    Index n = 0;
    for (int i = 0; i < codes.size(); ++i) n += is_object(codes[i]) && counts(codes[i]);
    return n;
  }

  /// A contest of sizes: n_a^k against that of the other attribute and of a quiet word.
  static void choose(const Config& c, S focus, Tables& t) {
    using Row = Eigen::Array<S, 1, Eigen::Dynamic>;
    std::array<Row, kAttributes> size;
    S largest = 0;
    for (int a = 0; a < kAttributes; ++a) {
      size[a] = (t.effect[a].array().square().colwise().sum() / static_cast<S>(t.objects)).sqrt();
      largest = std::max(largest, size[a].maxCoeff());
    }
    if (!(largest > S(0))) {
      t.share.setOnes();
      return;
    }
    const auto power = [&](const Row& n) -> Row {
      return (n / largest).pow(static_cast<S>(c.word_choice));
    };
    const Row type = power(size[0]), color = power(size[1]);
    const auto quiet = static_cast<S>(std::pow(c.quiet_word, c.word_choice));
    const Row sum = type + color + quiet + static_cast<S>(1e-12);
    t.share.row(0) = S(1) - focus * (S(1) - type / sum);
    t.share.row(1) = S(1) - focus * (S(1) - color / sum);
  }
};

}  // namespace wordgaze::model
