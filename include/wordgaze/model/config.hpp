#pragma once
#include <array>
#include <string_view>
#include <tuple>

#include "wordgaze/core/require.hpp"
#include "wordgaze/core/setting.hpp"

namespace wordgaze::model {

/// What a cell's visual encoding looks at.
enum class Encoder {
  cell,   ///< the cell alone: a 1x1 convolution
  patch,  ///< the 5x5 cells around it: two 3x3 convolutions
};
constexpr std::array<std::string_view, 2> names(Encoder) { return {"1x1", "3x3"}; }

/// Sizes and readings of the network, named as in the paper; docs/reading.md gives the reasons.
struct Config {
  bool attention = true;          ///< false: the baseline, F = O~
  bool task_attention = false;    ///< the Task Attention Module
  bool task_places = false;       ///< it reads the weighted words place by place, not their sum
  bool completion_input = false;  ///< c_t goes to the memory, beside the filtered view
  Encoder encoder = Encoder::cell;
  int channels = 16;         ///< C: feature maps of the visual encoding O~
  int word_size = 16;        ///< E: word embedding g~
  int key_size = 16;         ///< d_k
  int memory_size = 64;      ///< LSTM
  int text_size = 32;        ///< GRU over the mission
  int head_size = 64;        ///< hidden layer of actor and of critic
  int task_size = 64;        ///< hidden layer of the Task Attention Module
  int task_words = 32;       ///< outputs of the Task Attention Module: longest mission it takes
  int sub_tasks = 4;         ///< length of the completion vector c_t
  double entropy_base = 49;  ///< base of the logarithm in the row entropies H (eq. 2)
  double gaze_exponent = 2;  ///< p in s(M) = f + (1 - f) (M / max M)^p
  double gaze_floor = 0.1;   ///< f: what is left of the darkest cells
  double object_prior = 2;   ///< initial score of every word on objects over other cells; 0: none
  double encoder_bias = 1;   ///< initial bias of the visual encoder: near-linear at the start
  double encoder_leak = 1;   ///< slope of its leaky ReLU below zero; 1: linear, 0: plain ReLU

  static constexpr auto settings() {
    using C = Config;
    return std::tuple{
        Setting{"attention", &C::attention, "text-visual attention; false is the baseline"},
        Setting{"task_attention", &C::task_attention, "the Task Attention Module (mask alpha)"},
        Setting{"task_places", &C::task_places,
                "the module reads the weighted words place by place instead of their sum, which "
                "does not know their order"},
        Setting{"completion_input", &C::completion_input,
                "the memory reads c_t too; an ablation of the Task Attention Module"},
        Setting{"encoder", &C::encoder,
                "convolution of the visual encoding: of each cell alone, or two of 3x3 cells"},
        Setting{"channels", &C::channels, "C, feature maps of the visual encoding", 1, 1024},
        Setting{"word_size", &C::word_size, "E, size of a word embedding", 1, 1024},
        Setting{"key_size", &C::key_size, "d_k, size of queries and keys", 1, 1024},
        Setting{"memory_size", &C::memory_size, "hidden size of the LSTM", 1, 4096},
        Setting{"text_size", &C::text_size, "hidden size of the GRU over the mission", 1, 4096},
        Setting{"head_size", &C::head_size, "hidden layer of the actor and of the critic", 1, 4096},
        Setting{"task_size", &C::task_size, "hidden layer of the Task Attention Module", 1, 4096},
        Setting{"task_words", &C::task_words,
                "longest mission, in words, that the Task Attention Module takes", 1, 73},
        Setting{"sub_tasks", &C::sub_tasks, "length of the completion vector c_t", 1, 8, "clauses"},
        Setting{"entropy_base", &C::entropy_base,
                "base of the logarithm in the row entropies (eq. 2); 2.718281828 or 49", 1.1, 1e6},
        Setting{"gaze_exponent", &C::gaze_exponent, "p in s(M) = f + (1 - f) (M / max M)^p", 1, 16},
        Setting{"gaze_floor", &C::gaze_floor,
                "f in it: what is left of the darkest cells; 0: nothing", 0, 1},
        Setting{"object_prior", &C::object_prior,
                "initial score of every word on objects over other cells; 0 switches it off", 0,
                16},
        Setting{"encoder_bias", &C::encoder_bias,
                "initial bias of the visual encoder (1: near-linear at the start)", -4, 4},
        Setting{
            "encoder_leak", &C::encoder_leak,
            "slope of the encoder's leaky ReLU below zero; 1 is a linear encoder, 0 the plain ReLU",
            0, 1},
    };
  }

  bool operator==(const Config&) const = default;
};

/// Throws std::invalid_argument where settings contradict each other.
inline void validate(const Config& c) {
  require(c.attention || !c.task_attention,
          "model: task_attention = true masks word weights, so it needs attention = true (it is "
          "false); set model.attention=true or model.task_attention=false");
}

}  // namespace wordgaze::model
