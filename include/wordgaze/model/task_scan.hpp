#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <vector>

#include "wordgaze/babyai/vocabulary.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/missions.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// A Task Attention Module that composes; equations (T4)-(T10) in docs/math.md. It reads the words
/// of a mission once in each direction and carries along which sub-task it is in, so that "is
/// something before me still to be done?" is a scan: what it learns from two clauses holds for
/// eight.
///
/// Four numbers a word of the vocabulary, learned:
///
///     move   "and", "then": what follows belongs to the next sub-task
///     wait   "then": what follows waits for all before it
///     turn   "after": what follows comes first, and all before it waits
///     own    how bright the word is where nothing speaks against it
///
/// The mask depends on the mission and on what is done of it, not on the view: it is made once for
/// each such pair.
///
/// shapes   masks [L or more, M]: column m for a mission
/// backward accumulates into grads (+=)
template <std::floating_point S>
struct TaskScan {
  struct Params {
    Matrix<S> words;  ///< [4, V] rows move, wait, turn (before the sigmoid), own
    Vector<S> rules;  ///< [3] how much "done", "something before" and "something behind" darken
    static constexpr auto fields() {
      return std::tuple{nn::Field{"words", &Params::words}, nn::Field{"rules", &Params::rules}};
    }
  };

  static void resize(Params& p) {
    p.words.resize(4, babyai::kVocabularySize);
    p.rules.resize(3);
  }
  /// Words move nothing and are bright until they are taught.
  static void initialize(Params& p) {
    p.words.topRows(3).setConstant(S(-2));
    p.words.row(3).setConstant(S(2));
    p.rules.setConstant(S(4));
  }

  using Place = std::array<S, kMaxSubTasks>;  ///< in the completion vector

  /// What a word finds out.
  struct Word {
    S move, wait, turn;  // gates
    Place place;         // of its sub-task
    S undone;            // that sub-task is
    S before, held;      // something to the left is undone; and this word waits for it
    S behind, turned;    // something from here on is undone; and comes first
  };
  struct Cache {
    std::vector<Word> words, gradient;  // of one mission
  };

  /// alpha of the words of all missions; behind a mission's end it is 0.
  static void forward(const Params& p, const Missions& missions, Cache& k, Out<S> masks) {
    masks.setZero();
    for (int m = 0; m < missions.size(); ++m) {
      scan(p, missions[m], k);
      for (std::size_t j = 0; j < k.words.size(); ++j) {
        masks(static_cast<Index>(j), m) = S(1) / (S(1) + std::exp(-logit(p, missions[m], k, j)));
      }
    }
  }

  /// dlogits: gradient of the logits of the masks.
  static void backward(const Params& p, const Missions& missions, In<S> dlogits, Cache& k,
                       Params& grads) {
    for (int m = 0; m < missions.size(); ++m) {
      if (dlogits.col(m).isZero(S(0))) continue;
      scan(p, missions[m], k);
      scan_backward(p, missions[m], dlogits.col(m), k, grads);
    }
  }

 private:
  static S sigmoid(S x) { return S(1) / (S(1) + std::exp(-x)); }
  static Index id(const Mission& mission, std::size_t j) { return mission.words[j]; }

  static S logit(const Params& p, const Mission& mission, const Cache& k, std::size_t j) {
    const Word& w = k.words[j];
    return p.words(3, id(mission, j)) - p.rules(0) * (S(1) - w.undone) - p.rules(1) * w.held -
           p.rules(2) * w.turned;
  }

  static void scan(const Params& p, const Mission& mission, Cache& k) {
    const auto length = static_cast<std::size_t>(mission.length);
    k.words.resize(length);
    Word start{};
    start.place[0] = S(1);
    for (std::size_t j = 0; j < length; ++j) {
      const Word& last = j == 0 ? start : k.words[j - 1];
      Word& w = k.words[j];
      w.move = sigmoid(p.words(0, id(mission, j)));
      w.wait = sigmoid(p.words(1, id(mission, j)));
      w.turn = sigmoid(p.words(2, id(mission, j)));
      w.undone = S(1);
      for (std::size_t i = 0; i < kMaxSubTasks; ++i) {
        w.place[i] = (S(1) - w.move) * last.place[i] + (i > 0 ? w.move * last.place[i - 1] : S(0));
        if (mission.done[i]) w.undone -= w.place[i];
      }
      w.before = (S(1) - w.turn) * (last.before + w.move * (S(1) - last.before) * last.undone);
      w.held = (S(1) - w.turn) * ((S(1) - w.wait) * last.held + w.wait * w.before);
    }
    S behind = 0, turned = 0, turn = 0;  // of the word to the right
    for (std::size_t j = length; j-- > 0;) {
      Word& w = k.words[j];
      w.turned = turned + turn * (S(1) - turned) * behind;
      w.behind = behind + (S(1) - behind) * w.undone;
      behind = w.behind;
      turned = w.turned;
      turn = w.turn;
    }
  }

  template <class Gradient>
  static void scan_backward(const Params& p, const Mission& mission, const Gradient& dlogits,
                            Cache& k, Params& grads) {
    const std::size_t length = k.words.size();
    auto& d = k.gradient;
    d.assign(length, Word{});
    for (std::size_t j = 0; j < length; ++j) {
      const Word& w = k.words[j];
      const S dl = dlogits(static_cast<Index>(j));
      grads.words(3, id(mission, j)) += dl;
      grads.rules(0) -= dl * (S(1) - w.undone);
      grads.rules(1) -= dl * w.held;
      grads.rules(2) -= dl * w.turned;
      d[j].undone = dl * p.rules(0);
      d[j].held = -dl * p.rules(1);
      d[j].turned = -dl * p.rules(2);
    }
    // The scan from the right, back to the right.
    for (std::size_t j = 0; j < length; ++j) {
      const Word& w = k.words[j];
      const bool last = j + 1 == length;
      const S behind = last ? S(0) : k.words[j + 1].behind;
      d[j].undone += d[j].behind * (S(1) - behind);
      if (last) continue;
      const Word& right = k.words[j + 1];
      Word& dr = d[j + 1];
      dr.behind +=
          d[j].behind * (S(1) - w.undone) + d[j].turned * right.turn * (S(1) - right.turned);
      dr.turned += d[j].turned * (S(1) - right.turn * right.behind);
      dr.turn += d[j].turned * (S(1) - right.turned) * right.behind;
    }
    // The scan from the left, back to the left.
    Word start{};
    start.place[0] = S(1);
    Word nothing{};
    for (std::size_t j = length; j-- > 0;) {
      const Word& w = k.words[j];
      const Word& last = j == 0 ? start : k.words[j - 1];
      Word& dw = d[j];
      Word& dl = j == 0 ? nothing : d[j - 1];
      const S held = (S(1) - w.wait) * last.held + w.wait * w.before;
      dw.turn -= dw.held * held;
      const S dheld = dw.held * (S(1) - w.turn);
      dw.wait += dheld * (w.before - last.held);
      dw.before += dheld * w.wait;
      dl.held += dheld * (S(1) - w.wait);
      const S before = last.before + w.move * (S(1) - last.before) * last.undone;
      dw.turn -= dw.before * before;
      const S dbefore = dw.before * (S(1) - w.turn);
      dw.move += dbefore * (S(1) - last.before) * last.undone;
      dl.undone += dbefore * w.move * (S(1) - last.before);
      dl.before += dbefore * (S(1) - w.move * last.undone);
      for (std::size_t i = 0; i < kMaxSubTasks; ++i) {
        const S dplace = dw.place[i] - (mission.done[i] ? dw.undone : S(0));
        const S previous = i > 0 ? last.place[i - 1] : S(0);
        dw.move += dplace * (previous - last.place[i]);
        dl.place[i] += dplace * (S(1) - w.move);
        if (i > 0) dl.place[i - 1] += dplace * w.move;
      }
      const auto gate = [&](Index row, S value, S dvalue) {
        grads.words(row, id(mission, j)) += dvalue * value * (S(1) - value);
      };
      gate(0, w.move, dw.move);
      gate(1, w.wait, dw.wait);
      gate(2, w.turn, dw.turn);
    }
  }
};

}  // namespace wordgaze::model
