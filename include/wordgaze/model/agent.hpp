#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/team.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/design.hpp"
#include "wordgaze/model/frames.hpp"
#include "wordgaze/model/head.hpp"
#include "wordgaze/model/missions.hpp"
#include "wordgaze/model/outputs.hpp"
#include "wordgaze/model/task_attention.hpp"
#include "wordgaze/model/text_encoder.hpp"
#include "wordgaze/model/text_visual_attention.hpp"
#include "wordgaze/model/vision.hpp"
#include "wordgaze/nn/lstm.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// The group of parameters that learns at the second of the two rates (nn::Field::group).
inline constexpr int kTaskGroup = 1;

/// The whole network: vision, text-visual attention, memory, text, optional task attention, two
/// heads. docs/math.md has every equation, docs/architecture.md the data flow with its shapes.
///
/// An agent is a design and the steps of the computation; weights, gradients and memory are
/// arguments. Vision and Attention are blocks that can be replaced: vision.hpp says what a vision
/// offers, and TextVisualAttention what an attention does.
template <std::floating_point S, class Vision_ = ConfiguredVision<S>,
          class Attention_ = TextVisualAttention<S>>
struct Agent : Design {
  using Scalar = S;
  using Vision = Vision_;
  using Attention = Attention_;
  using Memory = nn::Lstm<S>;
  using Text = TextEncoder<S>;
  using Task = TaskAttention<S>;

  Agent() = default;
  Agent(const Config& c, CellAlphabet a) : Design{c, std::move(a)} {}

  struct Params {
    typename Vision::Params vision;
    Matrix<S> words;  ///< [E, V] embeddings g~; column 0 (padding) is never read
    typename Attention::Params attention;  ///< empty without attention
    typename Memory::Params memory;
    typename Text::Params text;
    typename Task::Params task;  ///< empty without task attention
    Matrix<S> completion;        ///< [4 H, sub_tasks]; empty unless completion_input
    typename Head<S>::Params actor, critic;
    static constexpr auto fields() {
      return std::tuple{nn::Field{"", &Params::vision},
                        nn::Field{"words", &Params::words},
                        nn::Field{"attention", &Params::attention},
                        nn::Field{"memory", &Params::memory},
                        nn::Field{"text", &Params::text},
                        nn::Field{"task", &Params::task, kTaskGroup},
                        nn::Field{"completion", &Params::completion},
                        nn::Field{"actor", &Params::actor},
                        nn::Field{"critic", &Params::critic}};
    }
  };

  /// What depends on the weights alone: frames only gather from it.
  struct Tables {
    typename Vision::Tables vision;
    typename Attention::Tables attention;
    Matrix<S> text;  ///< [3 G, V]
    static constexpr auto fields() {
      return std::tuple{nn::Field{"vision", &Tables::vision},
                        nn::Field{"attention", &Tables::attention},
                        nn::Field{"text", &Tables::text}};
    }
  };

  /// Parameters with their tables: refresh() makes the tables, after every change of the
  /// parameters. A gradient has the same type: backward() fills both, reduce() turns the tables'
  /// part into the parameters'.
  struct Weights {
    Params params;
    Tables tables;
    static constexpr auto fields() {
      return std::tuple{nn::Field{"params", &Weights::params},
                        nn::Field{"tables", &Weights::tables}};
    }
  };

  /// Everything that backward needs of forward: the tape.
  struct Cache {
    typename Vision::Cache vision;
    typename Attention::Cache attention;
    typename Task::Cache task;
    typename TaskScan<S>::Cache scan;
    typename Memory::Cache memory;
    typename Text::Cache text;
    typename Head<S>::Cache actor, critic;
    Matrix<S> alpha, dalpha;        ///< [words, N]: ones without the task module
    Matrix<S> ones, dscale;         // [P, N]; s(M) is ones without attention
    Matrix<S> product, dproduct;    // [4 H, N]
    Matrix<S> features, dfeatures;  ///< [H + G, N]: memory over text
    Matrix<S> dfeatures_of_actor;   // [H + G, N]
    Matrix<S> dtext;                // [G, M or more]
    // Of a task reader that scans, alpha of each mission and what is asked of it and its logits:
    Matrix<S> mission_mask, dmission_mask, dmission_logits;  // [mask_words, M or more]
    nn::SequenceShape shape;
  };

  Params make_params() const;
  Weights make_weights() const { return {make_params(), make_tables()}; }
  Weights make_weights(Params params) const {
    Weights w{std::move(params), make_tables()};
    refresh(w);
    return w;
  }
  /// Room for the gradients of a team; refers to what reduce() needs of each.
  std::vector<Weights> make_gradients(int workers) const;
  /// Random parameters for the start of training; docs/reading.md says which of it is a prior.
  Params initialize(core::Rng& rng) const;

  /// Makes the tables of these parameters.
  void refresh(Weights& w, Team& team) const;
  void refresh(Weights& w) const {
    Team alone(1);
    refresh(w, alone);
  }

  /// What is made once a mission [mission_features(config), M or more]: the text feature u, and
  /// under it the mask alpha where the task reader scans. backward wants to find it in the cache.
  void encode_text(const Weights& w, const Missions& missions, Cache& k, Out<S> features) const {
    Matrix<S>* mask = nullptr;
    if (scans(config)) {
      if (k.mission_mask.cols() != features.cols()) {
        k.mission_mask.resize(mask_words(config), features.cols());
      }
      TaskScan<S>::forward(w.params.task.scan, missions, k.scan, k.mission_mask);  // (T4)-(T10)
      features.bottomRows(mask_words(config)) = k.mission_mask;
      mask = &k.mission_mask;
    }
    Text::forward(w.params.text, w.tables.text, missions, mask, k.text,
                  features.topRows(config.text_size));
  }

  /// From frames and the features of their missions to the outputs.
  void forward(const Weights& w, const Frames<S>& x, const Missions& missions,
               In<S> mission_features, Cache& k, Outputs<S>& y) const;

  /// From the gradient of the outputs to those of the weights (+=). The missions are those that
  /// encode_text saw last in this cache.
  void backward(const Weights& w, const Frames<S>& x, const Missions& missions, const Outputs<S>& y,
                const Outputs<S>& dy, Cache& k, Weights& grads) const;

  /// The gradients of all workers, summed in their order into the params of the first; the same
  /// number of workers gives the same bits.
  void reduce(const Weights& w, std::span<Weights> grads, Team& team) const;

  /// How far the gaze has focused, in [0, 1]; only ever more. Returns whether weights have changed.
  bool set_focus(Params& p, double focus) const {
    return config.attention && Attention::set_focus(p.attention, focus);
  }

  /// s(M) [P, N], after forward; ones without attention.
  const Matrix<S>& scale(const Cache& k) const {
    return config.attention ? k.attention.scale : k.ones;
  }
  /// The entry of a map that belongs to a cell of frame n.
  Index entry(const CellMatrix& cells, Index cell, Index n) const {
    return Vision::entry(*this, cells, cell, n);
  }
  /// What M has on nowhere in frame n; 0 for a gaze that does not know it.
  S nowhere(const Cache& k, Index n) const {
    return config.gaze == Gaze::product ? k.attention.gaze(k.attention.nowhere, n) : S(0);
  }

 private:
  Tables make_tables() const;
  /// Sizes the cache for these frames; does nothing from the second call on.
  void fit(nn::SequenceShape shape, Index longest, Cache& k, Outputs<S>& y) const;
  void attend(const Weights& w, const Frames<S>& x, const Missions& missions,
              In<S> mission_features, Cache& k, Outputs<S>& y) const;
  void mask(const Weights& w, const Frames<S>& x, const Missions& missions, In<S> mission_features,
            Cache& k, Outputs<S>& y) const;
  void attend_backward(const Weights& w, const Frames<S>& x, const Missions& missions,
                       const Outputs<S>& y, const Outputs<S>& dy, Cache& k, Weights& grads) const;
};

template <std::floating_point S, class V, class A>
void Agent<S, V, A>::forward(const Weights& w, const Frames<S>& x, const Missions& missions,
                             In<S> mission_features, Cache& k, Outputs<S>& y) const {
  const auto& [p, t] = w;
  fit(x.shape, missions.longest, k, y);
  V::forward(*this, p.vision, t.vision, x.cells, k.vision);              // (V): O~
  if (config.attention) attend(w, x, missions, mission_features, k, y);  // s(M)
  // (F1), (F2): W_x (O~ * s(M))
  V::read(*this, t.vision, p.memory.input_weight, x.cells, scale(k), k.vision, k.product);
  if (config.completion_input) k.product.noalias() += p.completion * x.completion;
  // (M1)-(M4): h, and under it u, the text of the mission
  auto h = k.features.topRows(config.memory_size);
  Memory::forward(p.memory, x.shape, k.product, x.keep, x.start, k.memory, h);
  for (Index n = 0; n < x.shape.columns(); ++n) {
    k.features.col(n).tail(config.text_size) =
        mission_features.col(x.mission(n)).head(config.text_size);
  }
  // (H): policy and value
  Head<S>::forward(p.actor, k.features, k.actor, y.logits);
  Head<S>::forward(p.critic, k.features, k.critic, y.values);
}

template <std::floating_point S, class V, class A>
void Agent<S, V, A>::attend(const Weights& w, const Frames<S>& x, const Missions& missions,
                            In<S> mission_features, Cache& k, Outputs<S>& y) const {
  const auto& t = w.tables;  // not a binding, which a lambda cannot capture everywhere
  V::with_scores(*this, t.vision, t.attention, x.cells, k.vision,
                 [&](const auto& counts, auto&& score_of) {
                   A::forward_words(config, t.attention, counts, score_of, x, missions,
                                    k.attention);  // (A1)-(A4): A, w
                   if (config.task_attention) mask(w, x, missions, mission_features, k, y);
                   A::forward_gaze(config, counts, score_of, x, missions, k.alpha,
                                   k.attention);  // (A5), (A6): M, s(M)
                 });
}

/// alpha, from this frame's weighted words or from what was read of its mission.
template <std::floating_point S, class V, class A>
void Agent<S, V, A>::mask(const Weights& w, const Frames<S>& x, const Missions& missions,
                          In<S> mission_features, Cache& k, Outputs<S>& y) const {
  const auto& p = w.params;
  if (scans(config)) {  // (T4)-(T10)
    for (Index n = 0; n < x.shape.columns(); ++n) {
      y.mask.col(n) = mission_features.col(x.mission(n)).tail(y.mask.rows());
    }
  } else {  // (T1)-(T3)
    Task::forward(config, p.task, p.words, k.attention.weights, x, missions, k.task, y.mask);
  }
  const Index words = std::min(k.alpha.rows(), y.mask.rows());
  k.alpha.topRows(words) = y.mask.topRows(words);
}

template <std::floating_point S, class V, class A>
void Agent<S, V, A>::backward(const Weights& w, const Frames<S>& x, const Missions& missions,
                              const Outputs<S>& y, const Outputs<S>& dy, Cache& k,
                              Weights& grads) const {
  const auto& [p, t] = w;
  auto& [dp, dt] = grads;
  Head<S>::backward(p.critic, k.features, dy.values, k.critic, dp.critic, k.dfeatures);
  Head<S>::backward(p.actor, k.features, dy.logits, k.actor, dp.actor, k.dfeatures_of_actor);
  k.dfeatures += k.dfeatures_of_actor;  // both heads read the features
  if (k.dtext.cols() < missions.size()) k.dtext.resize(config.text_size, missions.size());
  k.dtext.setZero();
  for (Index n = 0; n < x.shape.columns(); ++n) {
    k.dtext.col(x.mission(n)) += k.dfeatures.col(n).tail(config.text_size);
  }
  Matrix<S>* dmask = nullptr;
  if (scans(config)) {
    for (auto* m : {&k.dmission_mask, &k.dmission_logits}) {
      m->setZero(k.mission_mask.rows(), k.mission_mask.cols());
    }
    dmask = &k.dmission_mask;
  }
  Text::backward(p.text, missions, k.dtext, k.text, dp.text, dt.text, dmask);
  const auto dh = k.dfeatures.topRows(config.memory_size);
  Memory::backward(p.memory, x.shape, x.keep, dh, k.memory, dp.memory, k.dproduct);
  if (config.completion_input) dp.completion.noalias() += k.dproduct * x.completion.transpose();
  V::read_backward(*this, t.vision, p.memory.input_weight, x.cells, scale(k), k.dproduct, k.vision,
                   dp.memory.input_weight, dt.vision, k.dscale);
  if (config.attention) attend_backward(w, x, missions, y, dy, k, grads);
  V::backward(*this, p.vision, t.vision, x.cells, k.vision, dp.vision, dt.vision);
}

template <std::floating_point S, class V, class A>
void Agent<S, V, A>::attend_backward(const Weights& w, const Frames<S>& x, const Missions& missions,
                                     const Outputs<S>& y, const Outputs<S>& dy, Cache& k,
                                     Weights& grads) const {
  const auto& p = w.params;
  const auto& t = w.tables;
  auto& [dp, dt] = grads;
  A::backward_gaze(config, x, missions, k.alpha, k.dscale, k.attention, k.dalpha);
  if (scans(config)) {
    const Index words = std::min(k.dalpha.rows(), k.dmission_mask.rows());
    for (Index n = 0; n < x.shape.columns(); ++n) {
      k.dmission_logits.col(x.mission(n)) += dy.mask.col(n);
      k.dmission_mask.col(x.mission(n)).head(words) += k.dalpha.col(n).head(words);
    }
    const auto alpha = k.mission_mask.array();
    k.dmission_logits.array() += k.dmission_mask.array() * alpha * (S(1) - alpha);
    TaskScan<S>::backward(p.task.scan, missions, k.dmission_logits, k.scan, dp.task.scan);
  } else if (config.task_attention) {
    Task::backward(config, p.task, p.words, k.attention.weights, x, missions, y.mask, k.dalpha,
                   dy.mask, k.task, dp.task, k.attention.dweights, dp.words);
  }
  V::with_score_gradients(*this, t.vision, t.attention, k.vision, dt.vision, dt.attention,
                          [&](const auto& counts, auto&& take) {
                            A::backward_words(config, t.attention, counts, x, missions, k.alpha,
                                              k.attention, take);
                          });
}

template <std::floating_point S, class V, class A>
void Agent<S, V, A>::refresh(Weights& w, Team& team) const {
  auto& [p, t] = w;
  if (config.attention) A::refresh(config, p.attention, p.words, t.attention);
  V::refresh(*this, p.vision, t.attention, p.memory.input_weight, t.vision, team);
  Text::refresh(p.text, p.words, t.text);
}

template <std::floating_point S, class V, class A>
void Agent<S, V, A>::reduce(const Weights& w, std::span<Weights> grads, Team& team) const {
  const auto& [p, t] = w;
  auto& [dp, dt] = grads.front();
  team.run([&](int part) {
    for (const Weights& other : grads.subspan(1)) {
      nn::add(grads.front(), other, {part, team.size()});
    }
  });
  V::reduce(
      *this, t.vision, p.memory.input_weight,
      [&](int worker) -> auto& { return grads[static_cast<std::size_t>(worker)].tables.vision; },
      dp.memory.input_weight, team);
  Text::table_backward(p.text, p.words, dt.text, dp.text, dp.words);
  V::tables_backward(*this, t.vision, t.attention, dt.vision, dt.attention, dp.vision);
  if (config.attention) {
    A::tables_backward(p.attention, p.words, t.attention, dt.attention, dp.attention, dp.words);
  }
}

template <std::floating_point S, class V, class A>
typename Agent<S, V, A>::Params Agent<S, V, A>::make_params() const {
  const Config& c = config;
  Params p;
  V::resize(*this, p.vision);
  p.words.resize(c.word_size, babyai::kVocabularySize);
  if (c.attention) A::resize(c, p.attention);
  Memory::resize(grid::kViewCells * c.channels, c.memory_size, p.memory);
  nn::Gru<S>::resize(c.word_size, c.text_size, p.text);
  if (c.task_attention) Task::resize(c, p.task);
  if (c.completion_input) p.completion.resize(4 * c.memory_size, c.sub_tasks);
  Head<S>::resize(c.memory_size + c.text_size, c.head_size, grid::kActions, p.actor);
  Head<S>::resize(c.memory_size + c.text_size, c.head_size, 1, p.critic);
  nn::set_zero(p);
  return p;
}

template <std::floating_point S, class V, class A>
typename Agent<S, V, A>::Tables Agent<S, V, A>::make_tables() const {
  Tables t;
  V::resize(*this, t.vision);
  if (config.attention) A::resize(config, t.attention);
  t.text.setZero(3 * config.text_size, babyai::kVocabularySize);
  return t;
}

template <std::floating_point S, class V, class A>
std::vector<typename Agent<S, V, A>::Weights> Agent<S, V, A>::make_gradients(int workers) const {
  std::vector<Weights> grads(static_cast<std::size_t>(workers), make_weights());
  if (V::input_weight_from_tables(*this)) {
    for (Weights& other : std::span(grads).subspan(1)) {
      other.params.memory.input_weight.resize(0, 0);
    }
  }
  return grads;
}

template <std::floating_point S, class V, class A>
typename Agent<S, V, A>::Params Agent<S, V, A>::initialize(core::Rng& rng) const {
  const Config& c = config;
  Params p = make_params();
  V::initialize(*this, rng, p.vision);
  nn::fill_normal(p.words, rng);
  if (c.attention) {
    A::initialize(rng, p.attention);
    if (c.object_prior > 0) {
      V::set_object_channel(*this, p.vision);
      A::set_object_prior(c, p.attention, p.words);
    }
  }
  nn::fill_scaled(p.memory.input_weight, 1, rng);
  nn::fill_scaled(p.memory.hidden_weight, 1, rng);
  p.memory.bias.segment(c.memory_size, c.memory_size).setOnes();  // the forget gate
  const double gru_limit = 1 / std::sqrt(static_cast<double>(c.text_size));
  nn::fill_uniform(p.text.input_weight, gru_limit, rng);
  nn::fill_uniform(p.text.hidden_weight, gru_limit, rng);
  nn::fill_uniform(p.text.bias, gru_limit, rng);
  nn::fill_uniform(p.text.candidate_bias, gru_limit, rng);
  if (c.task_attention) Task::initialize(c, rng, p.task);
  for (auto* head : {&p.actor, &p.critic}) {
    nn::fill_scaled(head->hidden.weight, std::numbers::sqrt2, rng);
    nn::fill_scaled(head->output.weight, head == &p.actor ? 0.01 : 1.0, rng);
  }
  return p;
}

template <std::floating_point S, class V, class A>
void Agent<S, V, A>::fit(nn::SequenceShape shape, Index longest, Cache& k, Outputs<S>& y) const {
  // Whole packets a column, so that what is rounded how does not depend on earlier batches.
  const Index words = std::max<Index>((longest + 15) / 16 * 16, k.alpha.rows());
  const Index frames = shape.columns();
  if (y.logits.cols() != frames) y.resize(config, frames);
  if (shape == k.shape && words == k.alpha.rows()) return;
  const Config& c = config;
  k.shape = shape;
  V::resize(*this, frames, k.vision);
  if (c.attention) k.attention.resize(V::entries(*this), V::nowhere(*this), frames, words);
  if (c.task_attention && !scans(c)) k.task.resize(c, frames);
  k.memory.resize(c.memory_size, shape);
  for (auto* head : {&k.actor, &k.critic}) head->resize(c.head_size, frames);
  k.alpha.setOnes(words, frames);
  k.dalpha.setZero(c.task_attention && !scans(c) ? c.task_words : words, frames);
  k.ones.setOnes(V::entries(*this), frames);
  k.dscale.setZero(V::entries(*this), frames);
  for (auto* m : {&k.product, &k.dproduct}) m->resize(4 * c.memory_size, frames);
  for (auto* m : {&k.features, &k.dfeatures, &k.dfeatures_of_actor}) {
    m->setZero(c.memory_size + c.text_size, frames);
  }
}

}  // namespace wordgaze::model

#if WORDGAZE_COMPILED  // set by wordgaze::policy, whose library holds it
extern template struct wordgaze::model::Agent<float>;
#endif
