#pragma once
#include "wordgaze/babyai/vocabulary.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/model/config.hpp"
#include "wordgaze/model/filtered_input.hpp"
#include "wordgaze/model/filtered_map.hpp"
#include "wordgaze/model/head.hpp"
#include "wordgaze/model/patch_encoder.hpp"
#include "wordgaze/model/task_attention.hpp"
#include "wordgaze/model/text_encoder.hpp"
#include "wordgaze/model/text_visual_attention.hpp"
#include "wordgaze/model/visual_encoder.hpp"
#include "wordgaze/nn/lstm.hpp"

namespace wordgaze::model {

/// The agent's input: `shape.batch` sequences of `shape.steps` frames, one column a frame,
/// time-major.
template <std::floating_point S>
struct Frames {
  nn::SequenceShape shape;
  CellMatrix cells;                   ///< [49, T*B] code indices of the alphabet
  std::vector<int> mission_of;        ///< [T*B] index into Missions
  Matrix<S> keep;                     ///< [1, T*B] 0 where an episode begins, else 1
  Matrix<S> completion;               ///< [clauses, T*B] c_t; 0 for clauses that do not exist
  typename nn::Lstm<S>::State start;  ///< memory before the first step

  void resize(const Config& config, nn::SequenceShape new_shape) {
    shape = new_shape;
    cells.setZero(grid::kViewCells, shape.columns());
    mission_of.assign(static_cast<std::size_t>(shape.columns()), 0);
    keep.setOnes(1, shape.columns());
    completion.setZero(config.clauses, shape.columns());
    start.resize(config.memory_size, shape.batch);
  }
};

/// The whole network: text-visual attention, memory, text, optional task attention, two heads.
/// docs/math.md has every equation, docs/architecture.md the data flow with its shapes.
///
/// Work is split in two. Tables depend on the weights alone and are rebuilt once a weight version;
/// frames only gather from them. So the backward pass of the frames ends in the gradients of the
/// tables, and these turn into gradients of the weights once a minibatch.
///
/// The encoder decides how much of the visual half is a table. A 1x1 encoding is one, and so are
/// its scores and its products with the memory's input weight (FilteredInput). A 3x3 encoding is a
/// map a frame, of which the first layer alone is a table (PatchEncoder, FilteredMap).
template <std::floating_point S>
struct Agent {
  using Attention = TextVisualAttention<S>;
  using Memory = nn::Lstm<S>;

  Config config;
  CellAlphabet alphabet;

  struct Params {
    typename VisualEncoder<S>::Params visual;  ///< empty with 3x3
    typename PatchEncoder<S>::Params patches;  ///< empty with 1x1
    Matrix<S> words;  ///< [E, V] embeddings g~; column 0 (padding) is never read
    typename Attention::Params attention;
    typename Memory::Params memory;
    typename TextEncoder<S>::Params text;
    typename TaskAttention<S>::Params task;  ///< empty without task attention
    Matrix<S> completion;                    ///< [4 H, clauses]; empty unless completion_input
    typename Head<S>::Params actor, critic;
    static constexpr auto fields() {
      return std::tuple{
          nn::Field{"visual", &Params::visual}, nn::Field{"patches", &Params::patches},
          nn::Field{"words", &Params::words},   nn::Field{"attention", &Params::attention},
          nn::Field{"memory", &Params::memory}, nn::Field{"text", &Params::text},
          nn::Field{"task", &Params::task},     nn::Field{"completion", &Params::completion},
          nn::Field{"actor", &Params::actor},   nn::Field{"critic", &Params::critic}};
    }
  };

  /// What depends on the weights alone. Its gradient has the same type.
  struct Tables {
    Matrix<S> visual;                          ///< [C, P]; 1x1
    typename PatchEncoder<S>::Tables patches;  ///< 3x3
    typename Attention::Tables attention;
    Matrix<S> input;  ///< [4 H, 49 P]; 1x1
    Matrix<S> text;   ///< [3 G, V]
    Matrix<S> words;  ///< [E, V]: only as a gradient, from the task module
  };

  struct Cache {
    typename Attention::Cache attention;
    typename TaskAttention<S>::Cache task;
    typename Memory::Cache memory;
    typename TextEncoder<S>::Cache text;
    typename Head<S>::Cache actor, critic;
    typename PatchEncoder<S>::Cache patches;
    Vector<S> score;                // [P]: scratch, of one word with 3x3
    Matrix<S> filtered, dfiltered;  // [49 C, N]: F with 3x3
    Matrix<S> alpha;                // [words, N]: ones without the task module
    Matrix<S> dalpha;               // [words, N]
    Matrix<S> scale, dscale;        // [P, N]
    Matrix<S> features, dfeatures;  // [H + G, N]: memory over text
    nn::SequenceShape shape;

    const Matrix<S>& logits() const { return actor.output; }   ///< [7, N]
    const Matrix<S>& values() const { return critic.output; }  ///< [1, N]
  };

  /// Whether the encoding sees neighbors (3x3), so that it is no table.
  bool sees_patches() const { return config.encoder == Encoder::patch; }
  /// P: numbers of a map; see TextVisualAttention. Codes are filled up to whole packets with kinds
  /// that are never in view: columns of odd length cost twice the time.
  Index kinds() const {
    constexpr Index kPacket = 16;
    return sees_patches() ? kMapSlots : (alphabet.size() + kPacket - 1) / kPacket * kPacket;
  }
  /// Which of them belongs to a cell of frame n.
  Index kind(const CellMatrix& cells, Index cell, Index n) const {
    return sees_patches() ? map_slot(cell) : cells(cell, n);
  }
  /// O~ of a cell of frame n, after forward.
  Vector<S> encoding(const Tables& t, const Cache& k, const CellMatrix& cells, Index cell,
                     Index n) const {
    if (sees_patches()) return map_frame(k.patches.output, n).col(map_slot(cell));
    return t.visual.col(cells(cell, n));
  }
  /// s(M) [P, N], after forward; ones without attention.
  const Matrix<S>& scale(const Cache& k) const {
    return config.attention ? k.attention.scale : k.scale;
  }

  Params make_params() const;

  Tables make_tables() const;

  /// The tables of these weights, all but `input`.
  void update_tables(const Params& p, Tables& t) const;
  /// Cells [from, to) of the input table, after update_tables: the large one, to be shared out.
  /// Only 1x1 has it.
  void update_input_table(const Params& p, Index from, Index to, Tables& t) const;
  void update_all_tables(const Params& p, Tables& t) const {
    update_tables(p, t);
    if (!sees_patches()) update_input_table(p, 0, grid::kViewCells, t);
  }

  /// Cells [from, to) of dt.input -> memory.input_weight and dt.visual. Only 1x1 has it.
  void input_table_backward(const Params& p, const Tables& t, const Tables& dt, Index from,
                            Index to, Params& grads, Out<S> dvisual) const;
  /// The other tables' gradients -> weights; dt is used up.
  void tables_backward(const Params& p, const Tables& t, Tables& dt, Params& grads) const;
  void all_tables_backward(const Params& p, const Tables& t, Tables& dt, Params& grads) const {
    if (!sees_patches()) input_table_backward(p, t, dt, 0, grid::kViewCells, grads, dt.visual);
    tables_backward(p, t, dt, grads);
  }
  static void set_zero(Tables& t);
  /// Calls f(table of a, table of b...) for all tables whose gradients are to be summed but
  /// `input`.
  template <class F, class... T>
  static void for_each_small_table(F&& f, T&... t) {
    f(t.visual...);
    f(t.patches.first...);
    f(t.attention.probes...);
    f(t.attention.scores...);
    f(t.text...);
    f(t.words...);
  }

  /// Encodes all missions into the cache, from where text() takes their features [G, M].
  void encode_missions(const Params& p, const Tables& t, const Missions& missions, Cache& k) const;
  static auto text(const Cache& k) { return TextEncoder<S>::text(k.text); }

  /// From frames and the text features [G, M or more] of their missions to logits and values.
  void forward(const Params& p, const Tables& t, const Frames<S>& x, const Missions& missions,
               In<S> text, Cache& k) const;

  /// From dlogits [7, N] and dvalues [1, N] (and, with the task module, cache.task.dlogits: what
  /// the mask loss asks) to grads and dt; both accumulate (+=). The missions are those that
  /// encode_missions saw last in this cache.
  void backward(const Params& p, const Tables& t, const Frames<S>& x, const Missions& missions,
                In<S> dlogits, In<S> dvalues, Cache& k, Params& grads, Tables& dt) const;

 private:
  S leak() const { return static_cast<S>(config.encoder_leak); }
  S sharpness() const { return static_cast<S>(1 / std::log(config.entropy_base)); }

  void forward_scores(const Tables& t, const Frames<S>& x, const Missions& missions,
                      Cache& k) const;
  void backward_scores(const Tables& t, const Frames<S>& x, const Missions& missions, Cache& k,
                       Tables& dt) const;

  /// Sizes the cache for these frames; does nothing from the second call on.
  void fit(nn::SequenceShape shape, Index longest, Cache& k) const;

  /// The task module's input: sum_i w_i e_i, or the w_i e_i one below the other, over c_t.
  Index weighed_size() const {
    return config.task_places ? config.task_words * config.word_size : config.word_size;
  }
  /// The row of that input from which word i is added.
  Index weighed_row(Index i) const { return config.task_places ? i * config.word_size : 0; }
  void weigh_words(const Params& p, const Missions& missions, const Frames<S>& x, Cache& k) const;
  void weigh_words_backward(const Params& p, const Missions& missions, const Frames<S>& x, Cache& k,
                            Tables& dt) const;
};

// What follows is not inline, so that `extern template struct Agent<float>` spares its users the
// work of compiling it (see rl/actor.hpp).

template <std::floating_point S>
typename Agent<S>::Params Agent<S>::make_params() const {
  const Config& c = config;
  Params p;
  if (sees_patches()) {
    PatchEncoder<S>::resize(p.patches, c.channels);
  } else {
    VisualEncoder<S>::resize(p.visual, c.channels);
  }
  p.words.resize(c.word_size, babyai::kVocabularySize);
  if (c.attention) Attention::resize(p.attention, c.key_size, c.word_size, c.channels);
  Memory::resize(p.memory, grid::kViewCells * c.channels, c.memory_size);
  nn::Gru<S>::resize(p.text, c.word_size, c.text_size);
  if (c.task_attention) {
    nn::Linear<S>::resize(p.task.hidden, weighed_size() + c.clauses, c.task_size);
    nn::Linear<S>::resize(p.task.output, c.task_size, c.task_words);
  }
  if (c.completion_input) p.completion.resize(4 * c.memory_size, c.clauses);
  Head<S>::resize(p.actor, c.memory_size + c.text_size, c.head_size, grid::kActions);
  Head<S>::resize(p.critic, c.memory_size + c.text_size, c.head_size, 1);
  nn::set_zero(p);
  return p;
}

template <std::floating_point S>
typename Agent<S>::Tables Agent<S>::make_tables() const {
  const Config& c = config;
  Tables t;
  const Index codes = sees_patches() ? 0 : alphabet.size();
  t.visual.setZero(c.channels, codes);
  if (sees_patches()) t.patches.resize(c.channels, alphabet.size());
  if (c.attention) {
    t.attention.resize(c.key_size, c.channels, babyai::kVocabularySize,
                       sees_patches() ? 0 : kinds());
  }
  t.input.setZero(4 * c.memory_size, grid::kViewCells * codes);
  t.text.setZero(3 * c.text_size, babyai::kVocabularySize);
  t.words.setZero(c.word_size, babyai::kVocabularySize);
  return t;
}

template <std::floating_point S>
void Agent<S>::update_tables(const Params& p, Tables& t) const {
  if (config.attention) Attention::make_probes(p.attention, p.words, t.attention);
  if (sees_patches()) {
    PatchEncoder<S>::make_tables(p.patches, alphabet, t.patches);
  } else {
    VisualEncoder<S>::forward(p.visual, alphabet, leak(), t.visual);
    if (config.attention) Attention::make_scores(t.visual, t.attention);
  }
  TextEncoder<S>::make_table(p.text, p.words, t.text);
}

template <std::floating_point S>
void Agent<S>::update_input_table(const Params& p, Index from, Index to, Tables& t) const {
  FilteredInput<S>::make_table(p.memory.input_weight, t.visual, from, to, t.input);
}

template <std::floating_point S>
void Agent<S>::input_table_backward(const Params& p, const Tables& t, const Tables& dt, Index from,
                                    Index to, Params& grads, Out<S> dvisual) const {
  FilteredInput<S>::table_backward(p.memory.input_weight, t.visual, dt.input, from, to,
                                   grads.memory.input_weight, dvisual);
}

template <std::floating_point S>
void Agent<S>::tables_backward(const Params& p, const Tables& t, Tables& dt, Params& grads) const {
  TextEncoder<S>::table_backward(p.text, p.words, dt.text, grads.text, grads.words);
  grads.words += dt.words;
  if (sees_patches()) {
    PatchEncoder<S>::tables_backward(alphabet, dt.patches, grads.patches);
  } else {
    if (config.attention) {
      Attention::scores_backward(t.visual, t.attention, dt.attention, dt.visual);
    }
    VisualEncoder<S>::backward(alphabet, leak(), t.visual, dt.visual, grads.visual);
  }
  if (config.attention) {
    Attention::probes_backward(p.attention, p.words, t.attention, dt.attention, grads.attention,
                               grads.words);
  }
}

template <std::floating_point S>
void Agent<S>::set_zero(Tables& t) {
  for_each_small_table([](auto& table) { table.setZero(); }, t);
  t.input.setZero();
}

template <std::floating_point S>
void Agent<S>::encode_missions(const Params& p, const Tables& t, const Missions& missions,
                               Cache& k) const {
  TextEncoder<S>::forward(p.text, t.text, missions, k.text);
}

template <std::floating_point S>
void Agent<S>::forward(const Params& p, const Tables& t, const Frames<S>& x,
                       const Missions& missions, In<S> text, Cache& k) const {
  fit(x.shape, missions.longest, k);
  const Index hidden = config.memory_size;
  if (sees_patches()) PatchEncoder<S>::forward(p.patches, t.patches, x.cells, leak(), k.patches);
  if (config.attention) {
    forward_scores(t, x, missions, k);
    if (config.task_attention) {
      weigh_words(p, missions, x, k);
      TaskAttention<S>::forward(p.task, k.task);
      const Index words = std::min(k.alpha.rows(), k.task.alpha.rows());
      k.alpha.topRows(words) = k.task.alpha.topRows(words);
    }
    Attention::forward_gaze(missions, x.mission_of, k.alpha, static_cast<S>(config.gaze_exponent),
                            static_cast<S>(config.gaze_floor), k.attention);
  }
  if (sees_patches()) {
    FilteredMap<S>::forward(k.patches.output, scale(k), k.filtered);
    k.memory.gates.noalias() = p.memory.input_weight * k.filtered;
  } else {
    FilteredInput<S>::forward(t.input, x.cells, scale(k), k.memory.gates);
  }
  if (config.completion_input) k.memory.gates.noalias() += p.completion * x.completion;
  Memory::forward(p.memory, x.shape, x.keep, x.start, k.memory);
  k.features.topRows(hidden) = k.memory.h;
  for (Index n = 0; n < x.shape.columns(); ++n) {
    k.features.col(n).tail(config.text_size) = text.col(x.mission_of[static_cast<std::size_t>(n)]);
  }
  Head<S>::forward(p.actor, k.features, k.actor);
  Head<S>::forward(p.critic, k.features, k.critic);
}

template <std::floating_point S>
void Agent<S>::backward(const Params& p, const Tables& t, const Frames<S>& x,
                        const Missions& missions, In<S> dlogits, In<S> dvalues, Cache& k,
                        Params& grads, Tables& dt) const {
  const Index hidden = config.memory_size;
  k.dfeatures.setZero();
  Head<S>::backward(p.critic, k.features, dvalues, k.critic, grads.critic, k.dfeatures);
  Head<S>::backward(p.actor, k.features, dlogits, k.actor, grads.actor, k.dfeatures);
  k.text.dtext.setZero();
  for (Index n = 0; n < x.shape.columns(); ++n) {
    k.text.dtext.col(x.mission_of[static_cast<std::size_t>(n)]) +=
        k.dfeatures.col(n).tail(config.text_size);
  }
  TextEncoder<S>::backward(p.text, missions, k.text, grads.text, dt.text);
  Memory::backward(p.memory, x.shape, x.keep, k.dfeatures.topRows(hidden), k.memory, grads.memory);
  if (config.completion_input) {
    grads.completion.noalias() += k.memory.dgates * x.completion.transpose();
  }
  if (sees_patches()) {
    grads.memory.input_weight.noalias() += k.memory.dgates * k.filtered.transpose();
    k.dfiltered.noalias() = p.memory.input_weight.transpose() * k.memory.dgates;
    FilteredMap<S>::backward(k.patches.output, scale(k), k.dfiltered, k.patches.doutput, k.dscale);
  } else {
    FilteredInput<S>::backward(t.input, x.cells, scale(k), k.memory.dgates, dt.input, k.dscale);
  }
  if (config.attention) {
    Attention::backward_gaze(missions, x.mission_of, k.alpha, static_cast<S>(config.gaze_exponent),
                             static_cast<S>(config.gaze_floor), k.dscale, k.attention, k.dalpha);
    if (config.task_attention) {
      TaskAttention<S>::backward(p.task, k.dalpha, k.task, grads.task);
      weigh_words_backward(p, missions, x, k, dt);
    }
    backward_scores(t, x, missions, k, dt);
  }
  if (sees_patches()) {
    PatchEncoder<S>::backward(t.patches, x.cells, leak(), k.patches, grads.patches, dt.patches);
  }
}

/// Scores are columns of a table with 1x1; with 3x3 each frame's map is compared with the probes.
template <std::floating_point S>
void Agent<S>::forward_scores(const Tables& t, const Frames<S>& x, const Missions& missions,
                              Cache& k) const {
  const auto words = [&](auto&& score_of) {
    Attention::forward_words(score_of, missions, x.mission_of, sharpness(), k.attention);
  };
  if (sees_patches()) {
    words([&](Index n, Index, Index word) -> const Vector<S>& {
      k.score.noalias() = map_frame(k.patches.output, n).transpose() * t.attention.probes.col(word);
      return k.score;
    });
  } else {
    Attention::count_codes(x.cells, k.attention);
    words([&](Index, Index, Index word) { return t.attention.scores.col(word); });
  }
}

template <std::floating_point S>
void Agent<S>::backward_scores(const Tables& t, const Frames<S>& x, const Missions& missions,
                               Cache& k, Tables& dt) const {
  const auto words = [&](auto&& take) {
    Attention::backward_words(missions, x.mission_of, k.alpha, sharpness(), k.attention, take);
  };
  if (sees_patches()) {
    words([&](Index n, Index, Index word, const auto& dscore) {
      k.score = dscore;
      map_frame(k.patches.doutput, n).noalias() +=
          t.attention.probes.col(word) * k.score.transpose();
      dt.attention.probes.col(word).noalias() += map_frame(k.patches.output, n) * k.score;
    });
  } else {
    words([&](Index, Index, Index word, const auto& dscore) {
      dt.attention.scores.col(word) += dscore;
    });
  }
}

template <std::floating_point S>
void Agent<S>::fit(nn::SequenceShape shape, Index longest, Cache& k) const {
  // Whole packets a column, so that what is rounded how does not depend on earlier batches.
  const Index words = std::max<Index>((longest + 15) / 16 * 16, k.alpha.rows());
  if (shape == k.shape && words == k.alpha.rows()) return;
  require(!config.task_attention || longest <= config.task_words,
          "agent: a mission has {} words, the Task Attention Module takes {}; raise "
          "model.task_words",
          longest, config.task_words);
  const Index frames = shape.columns();
  k.shape = shape;
  if (config.attention) k.attention.resize(kinds(), frames, words);
  if (sees_patches()) {
    k.patches.resize(config.channels, frames);
    k.score.setZero(kinds());
    for (auto* m : {&k.filtered, &k.dfiltered}) {
      m->resize(grid::kViewCells * config.channels, frames);
    }
    // Each cell of the view is one of its kind.
    k.attention.counts.setZero(kinds(), frames);
    for (Index cell = 0; cell < grid::kViewCells; ++cell) {
      k.attention.counts.row(map_slot(cell)).setOnes();
    }
  }
  if (config.task_attention) {
    k.task.resize(weighed_size() + config.clauses, config.task_size, config.task_words, frames);
  }
  k.memory.resize(config.memory_size, shape);
  k.actor.resize(config.head_size, grid::kActions, frames);
  k.critic.resize(config.head_size, 1, frames);
  k.alpha.setOnes(words, frames);
  k.dalpha.setZero(config.task_attention ? config.task_words : words, frames);
  k.scale.setOnes(kinds(), frames);
  k.dscale.setZero(kinds(), frames);
  for (auto* m : {&k.features, &k.dfeatures}) {
    m->setZero(config.memory_size + config.text_size, frames);
  }
}

template <std::floating_point S>
void Agent<S>::weigh_words(const Params& p, const Missions& missions, const Frames<S>& x,
                           Cache& k) const {
  k.task.x.topRows(weighed_size()).setZero();
  k.task.x.bottomRows(config.clauses) = x.completion;
  for (Index n = 0; n < x.shape.columns(); ++n) {
    const auto& sentence = missions[x.mission_of[static_cast<std::size_t>(n)]];
    for (Index i = 0; i < sentence.length; ++i) {
      k.task.x.col(n).segment(weighed_row(i), config.word_size) +=
          k.attention.weights(i, n) * p.words.col(sentence.words[static_cast<std::size_t>(i)]);
    }
  }
}

template <std::floating_point S>
void Agent<S>::weigh_words_backward(const Params& p, const Missions& missions, const Frames<S>& x,
                                    Cache& k, Tables& dt) const {
  for (Index n = 0; n < x.shape.columns(); ++n) {
    const auto& sentence = missions[x.mission_of[static_cast<std::size_t>(n)]];
    for (Index i = 0; i < sentence.length; ++i) {
      const auto dx = k.task.dx.col(n).segment(weighed_row(i), config.word_size);
      const Index word = sentence.words[static_cast<std::size_t>(i)];
      k.attention.dweights(i, n) += p.words.col(word).dot(dx);
      dt.words.col(word) += k.attention.weights(i, n) * dx;
    }
  }
}

}  // namespace wordgaze::model
