#pragma once
#include "support/golden.hpp"
#include "wordgaze/model/agent.hpp"

/// The agent of a golden file of scripts/golden: its settings and its weights.
namespace wordgaze::test {

inline model::Config config_of(const Json& j) {
  model::Config c;
  c.attention = j.at("attention");
  c.task_attention = j.at("task_attention");
  c.completion_input = j.value("completion_input", false);
  c.encoder = j.at("encoder") == "3x3" ? model::Encoder::patch : model::Encoder::cell;
  c.channels = j.at("channels");
  c.word_size = j.at("word_size");
  c.key_size = j.at("key_size");
  c.memory_size = j.at("memory_size");
  c.text_size = j.at("text_size");
  c.head_size = j.at("head_size");
  c.task_size = j.at("task_size");
  c.task_words = j.at("task_words");
  c.sub_tasks = j.at("clauses");
  c.entropy_base = j.at("entropy_base");
  c.gaze_exponent = j.at("gaze_exponent");
  c.gaze_floor = j.at("gaze_floor");
  c.encoder_leak = j.at("encoder_leak");
  c.gaze = j.at("gaze") == "product" ? model::Gaze::product : model::Gaze::sum;
  c.task_reader = j.at("task_reader") == "scan" ? model::Reader::scan : model::Reader::sum;
  c.sharpness_start = j.at("sharpness_start");
  c.sharpness = j.at("sharpness");
  c.nowhere = j.at("nowhere");
  c.word_choice_start = j.at("word_choice_start");
  c.word_choice = j.at("word_choice");
  c.score_cost = j.at("score_cost");
  c.score_cost_start = j.value("score_cost_start", c.score_cost);
  return c;
}

/// Every leaf from the list under its path.
template <nn::Tree P>
void read_parameters(const Json& lists, P& params) {
  nn::for_each_parameter(
      [&](const nn::Path& path, auto& leaf) {
        if (leaf.size() == 0) return;
        using S = typename std::remove_cvref_t<decltype(leaf)>::Scalar;
        leaf = matrix(lists.at(path.str()), leaf.rows(), leaf.cols()).template cast<S>();
      },
      params);
}

}  // namespace wordgaze::test
