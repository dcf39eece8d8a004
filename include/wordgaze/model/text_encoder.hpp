#pragma once
#include <concepts>
#include <cstddef>

#include "wordgaze/babyai/vocabulary.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/missions.hpp"
#include "wordgaze/nn/gru.hpp"

namespace wordgaze::model {

/// The GRU over the mission; its last state is the text feature. Its input product is a table over
/// the vocabulary: columns are gathered, not multiplied.
///
/// shapes   words [E, V]: embeddings g~; table [3 G, V]; text [G, M or more] for M missions
/// backward accumulates into grads and dtable (+=)
template <std::floating_point S>
struct TextEncoder {
  using Params = typename nn::Gru<S>::Params;

  struct Cache {
    typename nn::Gru<S>::Cache gru;
    Matrix<S> product, dproduct;  // [3 G, T*M], perhaps wider
    Matrix<S> active;             // [1, T*M]
  };

  /// What depends on the weights alone, and the way back from it.
  static void refresh(const Params& p, In<S> words, Out<S> table) {
    table.noalias() = p.input_weight * words;
  }
  static void table_backward(const Params& p, In<S> words, In<S> dtable, Params& grads,
                             Out<S> dwords) {
    grads.input_weight.noalias() += dtable * words.transpose();
    dwords.noalias() += p.input_weight.transpose() * dtable;
  }

  /// With a mask [L or more, M] a word changes the state as far as it is bright.
  static void forward(const Params& p, In<S> table, const Missions& missions, const Matrix<S>* mask,
                      Cache& k, Out<S> text) {
    const nn::SequenceShape shape{missions.longest, missions.size()};
    const Index columns = shape.columns();
    if (k.active.cols() < columns) {
      k.active.resize(1, columns);
      for (auto* m : {&k.product, &k.dproduct}) m->resize(table.rows(), columns);
    }
    k.active.leftCols(columns).setZero();
    k.product.leftCols(columns).setZero();
    for_each_word(missions, shape, [&](int m, int i, Index column, babyai::WordId word) {
      k.active(0, column) = mask != nullptr ? (*mask)(i, m) : S(1);
      k.product.col(column) = table.col(word);
    });
    nn::Gru<S>::forward(p, shape, k.product, k.active, k.gru, text.leftCols(shape.batch));
  }
  /// dmask [L or more, M] is accumulated into, if there is one.
  static void backward(const Params& p, const Missions& missions, In<S> dtext, Cache& k,
                       Params& grads, Out<S> dtable, Matrix<S>* dmask) {
    const nn::SequenceShape shape{missions.longest, missions.size()};
    nn::Gru<S>::backward(p, shape, k.active, dtext.leftCols(shape.batch), k.gru, grads, k.dproduct);
    for_each_word(missions, shape, [&](int m, int i, Index column, babyai::WordId word) {
      dtable.col(word) += k.dproduct.col(column);
      if (dmask != nullptr) (*dmask)(i, m) += k.gru.dactive(0, column);
    });
  }

 private:
  template <class F>
  static void for_each_word(const Missions& missions, nn::SequenceShape shape, F&& f) {
    for (int m = 0; m < missions.size(); ++m) {
      const auto& sentence = missions[m];
      for (int i = 0; i < sentence.length; ++i) {
        f(m, i, shape.column(i, m), sentence.words[static_cast<std::size_t>(i)]);
      }
    }
  }
};

}  // namespace wordgaze::model
