#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>

#include "wordgaze/core/types.hpp"
#include "wordgaze/grid/cell.hpp"
#include "wordgaze/model/config.hpp"
#include "wordgaze/model/design.hpp"
#include "wordgaze/model/word_tables.hpp"

namespace wordgaze::model {

/// What a word says of the things that can be seen; equations (A8)-(A11) in docs/math.md.
///
/// The scores of a word on objects are taken apart into what depends on the type and what depends
/// on the color; what is left, and scores on what is no object, is not the word's to say. A gate
/// that is learned says of which of the two a word speaks, and hardens as the gaze focuses. So
/// "red" cannot learn to avoid balls where red balls are never named. And a word scores nowhere by
/// how well it could be matched: what matches less is not in view. The silent word scores nowhere
/// as the mean object: it may darken the floor, but how well an object has to match is for
/// `nowhere` alone to say.
///
/// shapes   scores [codes + 1, V + 1]: the last row is nowhere, the last column the silent word
template <std::floating_point S>
struct Lexicon {
  static constexpr int kAttributes = 2;  ///< type, color

  struct Tables {
    std::array<Matrix<S>, kAttributes> projector;  // [codes, codes] onto what an attribute says
    std::array<Matrix<S>, kAttributes> effect;     // [codes, V] of the raw scores
    std::array<Matrix<S>, kAttributes> scratch;    // [codes, V]
    Vector<S> objects;                             // [codes] 1 / number of objects, or 0
    Vector<S> of_type;                            ///< [V] share of the type; the color has the rest
    Eigen::Array<Index, Eigen::Dynamic, 1> best;  ///< [V] the code that matches a word best
  };

  static void resize(const Design& d, Tables& t) {
    const CellAlphabet& codes = d.alphabet;
    t.of_type.setZero(babyai::kVocabularySize);
    t.best.setZero(babyai::kVocabularySize);
    const auto objects = static_cast<S>(count(codes, [](const auto&) { return true; }));
    t.objects.setZero(codes.size());
    for (int i = 0; i < codes.size(); ++i) {
      if (is_object(codes[i])) t.objects(i) = S(1) / objects;
    }
    for (int a = 0; a < kAttributes; ++a) {
      t.projector[a].setZero(codes.size(), codes.size());
      for (auto* m : {&t.effect[a], &t.scratch[a]}) {
        m->setZero(codes.size(), babyai::kVocabularySize);
      }
      for (int i = 0; i < codes.size(); ++i) {
        if (!is_object(codes[i])) continue;
        const auto alike = [&](const CellAlphabet::Code& other) {
          return a == 0 ? other.type == codes[i].type : other.color == codes[i].color;
        };
        const auto share = static_cast<S>(1.0 / static_cast<double>(count(codes, alike)));
        for (int j = 0; j < codes.size(); ++j) {
          if (!is_object(codes[j])) continue;
          t.projector[a](i, j) = (alike(codes[j]) ? share : S(0)) - t.objects(j);
        }
      }
    }
  }

  /// On entry the first rows of scores are raw.
  static void forward(const Config& c, const WordTables<S>& words, Tables& t, Out<S> scores) {
    const Index codes = scores.rows() - 1;
    scores(codes, kSilentWord) = t.objects.dot(scores.col(kSilentWord).head(codes));
    auto spoken = scores.topLeftCorner(codes, kSilentWord);
    for (int a = 0; a < kAttributes; ++a) t.effect[a].noalias() = t.projector[a] * spoken;
    t.of_type =
        (S(1) + (-slope(c, words) * words.choice.row(0).transpose().array()).exp()).inverse();
    spoken = t.effect[0] * t.of_type.asDiagonal();
    spoken += t.effect[1] * (S(1) - t.of_type.array()).matrix().asDiagonal();
    for (Index v = 0; v < spoken.cols(); ++v) {
      scores(codes, v) = static_cast<S>(c.nowhere) * spoken.col(v).maxCoeff(&t.best(v));
    }
  }
  /// From the gradient of the scores to that of raw, in the place of its first rows, and to that of
  /// the gates (+=). What a word could say of an attribute has its price, (A12): so a word that has
  /// nothing to say falls silent.
  static void backward(const Config& c, const WordTables<S>& words, const Tables& t, Tables& dt,
                       Out<S> dscores, WordTables<S>& dwords) {
    const Index codes = t.projector[0].rows();
    dscores.col(kSilentWord).head(codes) += dscores(codes, kSilentWord) * t.objects;
    auto dspoken = dscores.topLeftCorner(codes, kSilentWord);
    for (Index v = 0; v < dspoken.cols(); ++v) {
      dspoken(t.best(v), v) += static_cast<S>(c.nowhere) * dscores(codes, v);
    }
    const S kappa = slope(c, words);
    for (Index v = 0; v < dspoken.cols(); ++v) {
      const S dof_type = dspoken.col(v).dot(t.effect[0].col(v) - t.effect[1].col(v));
      dwords.choice(0, v) += kappa * t.of_type(v) * (S(1) - t.of_type(v)) * dof_type;
    }
    dt.scratch[0] = dspoken * t.of_type.asDiagonal();
    dt.scratch[1] = dspoken - dt.scratch[0];
    // Projectors are symmetric, and twice applied are as once.
    const auto price = static_cast<S>(focused(c.score_cost_start, c.score_cost,
                                              static_cast<double>(words.focus))) *
                       words.sharpness * words.sharpness;
    dspoken = price * (t.effect[0] + t.effect[1]);
    for (int a = 0; a < kAttributes; ++a) dspoken.noalias() += t.projector[a] * dt.scratch[a];
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
  /// Of the gates: how hard a word has to choose.
  static S slope(const Config& c, const WordTables<S>& words) {
    return static_cast<S>(
        focused(c.word_choice_start, c.word_choice, static_cast<double>(words.focus)));
  }
};

}  // namespace wordgaze::model
