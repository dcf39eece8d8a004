#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>

#include "wordgaze/core/types.hpp"
#include "wordgaze/grid/cell.hpp"
#include "wordgaze/model/config.hpp"
#include "wordgaze/model/design.hpp"

namespace wordgaze::model {

/// What a word says of the things that can be seen; equations (A8)-(A11) in docs/math.md.
///
/// The scores of a word on objects are taken apart into what depends on the type and what depends
/// on the color; what is left, and scores on what is no object, is not the word's to say. As the
/// gaze focuses, a word keeps the attribute of which it says more, or says nothing. So "red" cannot
/// learn to avoid balls where red balls are never named. And a word scores nowhere by how well it
/// could be matched: what matches less is not in view.
///
/// shapes   scores [codes + 1, V]: the last row is nowhere
template <std::floating_point S>
struct Lexicon {
  static constexpr int kAttributes = 2;  ///< type, color

  struct Tables {
    std::array<Matrix<S>, kAttributes> projector;  // [codes, codes] onto what an attribute says
    std::array<Matrix<S>, kAttributes> effect;     // [codes, V] of the raw scores
    std::array<Matrix<S>, kAttributes> scratch;    // [codes, V]
    std::array<Vector<S>, kAttributes> size;       // [V] of an effect
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
      for (auto* m : {&t.effect[a], &t.scratch[a]}) {
        m->setZero(codes.size(), babyai::kVocabularySize);
      }
      t.size[a].setZero(babyai::kVocabularySize);
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

  /// On entry the first rows of scores are raw. `focus` in [0, 1]: how far words have chosen.
  static void forward(const Config& c, S focus, Tables& t, Out<S> scores) {
    const Index codes = scores.rows() - 1;
    for (int a = 0; a < kAttributes; ++a) {
      t.effect[a].noalias() = t.projector[a] * scores.topRows(codes);
    }
    choose(c, focus, t);
    auto spoken = scores.topRows(codes);
    spoken = t.effect[0] * t.share.row(0).asDiagonal();
    spoken += t.effect[1] * t.share.row(1).asDiagonal();
    for (Index v = 0; v < scores.cols(); ++v) {
      scores(codes, v) = static_cast<S>(c.nowhere) * spoken.col(v).maxCoeff(&t.best(v));
    }
  }
  /// From the gradient of the scores to that of raw, in the place of its first rows. The choice of
  /// an attribute is not differentiated. `price` is what the size of an effect costs: so a word
  /// says no more than it needs, and what one word can say is not shared out to six others.
  static void backward(const Config& c, const Tables& t, S price, Tables& dt, Out<S> dscores) {
    const Index codes = t.projector[0].rows();
    for (Index v = 0; v < dscores.cols(); ++v) {
      dscores(t.best(v), v) += static_cast<S>(c.nowhere) * dscores(codes, v);
    }
    auto dspoken = dscores.topRows(codes);
    // Projectors are symmetric.
    for (int a = 0; a < kAttributes; ++a) {
      dt.scratch[a] = dspoken * t.share.row(a).asDiagonal();
    }
    dspoken.noalias() = t.projector[0] * dt.scratch[0];
    dspoken.noalias() += t.projector[1] * dt.scratch[1];
    for (int a = 0; price > S(0) && a < kAttributes; ++a) {
      for (Index v = 0; v < dscores.cols(); ++v) {
        const S pull = price / (static_cast<S>(t.objects) * (t.size[a](v) + kSmallest));
        dspoken.col(v) += pull * t.effect[a].col(v);
      }
    }
  }

  /// What words tell apart.
  static bool is_object(const CellAlphabet::Code& code) {
    const auto type = static_cast<grid::Type>(code.type);
    return type >= grid::Type::door && type <= grid::Type::lava;
  }

 private:
  static constexpr S kSmallest = S(1e-6);  ///< size, whose direction is no longer told apart

  template <class Counts>
  static Index count(const CellAlphabet& codes, Counts&& counts) {
    Index n = 0;
    for (int i = 0; i < codes.size(); ++i) n += is_object(codes[i]) && counts(codes[i]);
    return n;
  }

  /// A contest of sizes: n_a^k against that of the other attribute and of a quiet word.
  static void choose(const Config& c, S focus, Tables& t) {
    S largest = 0;
    for (int a = 0; a < kAttributes; ++a) {
      for (Index v = 0; v < t.size[a].size(); ++v) {
        t.size[a](v) = std::sqrt(t.effect[a].col(v).squaredNorm() / static_cast<S>(t.objects));
      }
      largest = std::max(largest, t.size[a].maxCoeff());
    }
    if (!(largest > S(0))) {
      t.share.setOnes();
      return;
    }
    const auto power = [&](S n) { return std::pow(n, static_cast<S>(c.word_choice)); };
    const S quiet = power(static_cast<S>(c.quiet_word));
    for (Index v = 0; v < t.share.cols(); ++v) {
      const S type = power(t.size[0](v) / largest), color = power(t.size[1](v) / largest);
      // What a word has kept of an attribute where the gaze has focused.
      const S sum = std::max(type + color + quiet, std::numeric_limits<S>::min());
      t.share(0, v) = S(1) - focus * (S(1) - type / sum);
      t.share(1, v) = S(1) - focus * (S(1) - color / sum);
    }
  }
};

}  // namespace wordgaze::model
