#pragma once
#include "wordgaze/babyai/vocabulary.hpp"
#include "wordgaze/model/missions.hpp"
#include "wordgaze/nn/gru.hpp"

namespace wordgaze::model {

/// The GRU over the mission; its last state is the text feature. Its input product is a table over
/// the vocabulary: columns are gathered, not multiplied.
///
/// shapes   words [E, V]: embeddings g~; table [3 G, V]; text [G, M] for M missions
template <std::floating_point S>
struct TextEncoder {
  using Params = typename nn::Gru<S>::Params;

  struct Cache {
    typename nn::Gru<S>::Cache gru;
    Matrix<S> active;         // [1, T*M]
    Matrix<S> dtext;          // [G, M]
    nn::SequenceShape shape;  // of the batch; the matrices may be larger
  };

  static void make_table(const Params& p, In<S> words, Out<S> table) {
    table.noalias() = p.input_weight * words;
  }
  /// Turns the table's gradient into those of the input weight and of the embeddings (+=).
  static void table_backward(const Params& p, In<S> words, In<S> dtable, Params& grads,
                             Out<S> dwords) {
    grads.input_weight.noalias() += dtable * words.transpose();
    dwords.noalias() += p.input_weight.transpose() * dtable;
  }

  static void forward(const Params& p, In<S> table, const Missions& missions, Cache& k) {
    k.shape = {missions.longest, missions.size()};
    const Index hidden = p.hidden_weight.cols(), columns = k.shape.columns();
    k.gru.reserve(hidden, columns);
    if (k.active.cols() < columns) k.active.resize(1, columns);
    if (k.dtext.cols() < k.shape.batch) k.dtext.resize(hidden, k.shape.batch);
    k.active.leftCols(columns).setZero();
    k.gru.gates.leftCols(columns).setZero();
    for (int m = 0; m < missions.size(); ++m) {
      const auto& sentence = missions[m];
      for (int i = 0; i < sentence.length; ++i) {
        const Index column = k.shape.column(i, m);
        k.active(0, column) = S(1);
        k.gru.gates.col(column) = table.col(sentence.words[static_cast<std::size_t>(i)]);
      }
    }
    nn::Gru<S>::forward(p, k.shape, k.active, k.gru);
  }
  /// [G, M]
  static auto text(const Cache& k) { return k.shape.block(k.gru.h, k.shape.steps - 1); }

  /// On entry cache.dtext [G, M], perhaps wider, is the gradient of text().
  static void backward(const Params& p, const Missions& missions, Cache& k, Params& grads,
                       Out<S> dtable) {
    nn::Gru<S>::backward(p, k.shape, k.active, k.dtext.leftCols(k.shape.batch), k.gru, grads);
    for (int m = 0; m < missions.size(); ++m) {
      const auto& sentence = missions[m];
      for (int i = 0; i < sentence.length; ++i) {
        dtable.col(sentence.words[static_cast<std::size_t>(i)]) +=
            k.gru.dgates.col(k.shape.column(i, m));
      }
    }
  }
};

}  // namespace wordgaze::model
