#pragma once
#include <concepts>
#include <cstddef>
#include <numbers>
#include <tuple>

#include "wordgaze/core/require.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/frames.hpp"
#include "wordgaze/model/missions.hpp"
#include "wordgaze/model/task_scan.hpp"
#include "wordgaze/nn/initialize.hpp"
#include "wordgaze/nn/linear.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// The Task Attention Module; equations (T1)-(T3) in docs/math.md. An MLP that reads the weighted
/// words and the completion vector c_t and gives one number in (0, 1) a word: the mask alpha, which
/// silences the words of finished sub-tasks.
///
/// It reads the sum of all w_i e_i, or with `task_places` each w_i e_i in its place.
///
/// shapes   words [E, V]: embeddings e   weights [L, N]: w   alpha [task_words, N]
/// backward accumulates into grads, dweights, dwords (+=)
template <std::floating_point S>
struct TaskAttention {
  struct Params {
    typename nn::Linear<S>::Params hidden, output;  ///< empty where the reader is a scan
    typename TaskScan<S>::Params scan;              ///< empty for the other readers
    static constexpr auto fields() {
      return std::tuple{nn::Field{"hidden", &Params::hidden}, nn::Field{"output", &Params::output},
                        nn::Field{"scan", &Params::scan}};
    }
  };
  struct Cache {
    Matrix<S> x, dx;            // [words read + sub_tasks, N]
    Matrix<S> hidden, dhidden;  // [task_size, N]
    Matrix<S> dlogits;          // [task_words, N] before the sigmoid
    void resize(const Config& c, Index frames) {
      for (auto* m : {&x, &dx}) m->resize(words_read(c) + c.sub_tasks, frames);
      for (auto* m : {&hidden, &dhidden}) m->resize(c.task_size, frames);
      dlogits.resize(c.task_words, frames);
    }
  };

  static void resize(const Config& c, Params& p) {
    if (scans(c)) return TaskScan<S>::resize(p.scan);
    nn::Linear<S>::resize(words_read(c) + c.sub_tasks, c.task_size, p.hidden);
    nn::Linear<S>::resize(c.task_size, c.task_words, p.output);
  }
  static void initialize(const Config& c, core::Rng& rng, Params& p) {
    if (scans(c)) return TaskScan<S>::initialize(p.scan);
    nn::fill_scaled(p.hidden.weight, std::numbers::sqrt2, rng);
    nn::fill_scaled(p.output.weight, 0.1, rng);
    p.output.bias.setConstant(2);  // every word bright at the start
  }

  static void forward(const Config& c, const Params& p, In<S> words, In<S> weights,
                      const Frames<S>& x, const Missions& missions, Cache& k, Out<S> alpha) {
    require(missions.longest <= c.task_words,
            "agent: a mission has {} words, the Task Attention Module takes {}; raise "
            "model.task_words",
            missions.longest, c.task_words);
    k.x.topRows(words_read(c)).setZero();
    k.x.bottomRows(c.sub_tasks) = x.completion;
    for_each_word(c, x, missions, [&](Index n, Index i, Index row, babyai::WordId word) {
      k.x.col(n).segment(row, c.word_size) += weights(i, n) * words.col(word);
    });
    nn::Linear<S>::forward(p.hidden, k.x, {}, k.hidden);
    k.hidden = k.hidden.cwiseMax(S(0));
    nn::Linear<S>::forward(p.output, k.hidden, {}, alpha);
    alpha = alpha.array().logistic();
  }
  /// dalpha is what the gaze asks of alpha, dlogits what a loss asks of alpha's logits.
  static void backward(const Config& c, const Params& p, In<S> words, In<S> weights,
                       const Frames<S>& x, const Missions& missions, In<S> alpha, In<S> dalpha,
                       In<S> dlogits, Cache& k, Params& grads, Out<S> dweights, Out<S> dwords) {
    k.dlogits = dlogits.array() + dalpha.array() * alpha.array() * (S(1) - alpha.array());
    nn::Linear<S>::backward(p.output, k.hidden, k.dlogits, {}, grads.output, k.dhidden);
    k.dhidden.array() *= (k.hidden.array() > S(0)).template cast<S>();
    nn::Linear<S>::backward(p.hidden, k.x, k.dhidden, {}, grads.hidden, k.dx);
    for_each_word(c, x, missions, [&](Index n, Index i, Index row, babyai::WordId word) {
      const auto dx = k.dx.col(n).segment(row, c.word_size);
      dweights(i, n) += words.col(word).dot(dx);
      dwords.col(word) += weights(i, n) * dx;
    });
  }

 private:
  static Index words_read(const Config& c) {
    return c.task_reader == Reader::places ? c.task_words * c.word_size : c.word_size;
  }
  /// Calls f(frame, place in the mission, first row of x that the word is added to, word).
  template <class F>
  static void for_each_word(const Config& c, const Frames<S>& x, const Missions& missions, F&& f) {
    for (Index n = 0; n < x.shape.columns(); ++n) {
      const auto& sentence = missions[x.mission(n)];
      for (Index i = 0; i < sentence.length; ++i) {
        f(n, i, c.task_reader == Reader::places ? i * c.word_size : 0,
          sentence.words[static_cast<std::size_t>(i)]);
      }
    }
  }
};

}  // namespace wordgaze::model
