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
///
/// Members are defined in agent_impl.hpp and compiled once a scalar: Agent<float> in the library.
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

}  // namespace wordgaze::model
