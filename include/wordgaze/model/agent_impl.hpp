#pragma once
#include "wordgaze/model/agent.hpp"

/// The definitions of Agent's members, for the one translation unit that instantiates it:
/// Agent<float> is in the library (src/model/agent.cpp), so its users need agent.hpp alone.
namespace wordgaze::model {

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
