#pragma once
#include <array>
#include <cmath>
#include <string_view>
#include <tuple>

#include "wordgaze/babyai/vocabulary.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/core/setting.hpp"

namespace wordgaze::model {

/// What a cell's visual encoding looks at.
enum class Encoder {
  cell,   ///< the cell alone: a 1x1 convolution
  patch,  ///< the 5x5 cells around it: two 3x3 convolutions
};
constexpr std::array<std::string_view, 2> names(Encoder) { return {"1x1", "3x3"}; }

/// How the maps of the words become the gaze M.
enum class Gaze {
  product,  ///< their weighted geometric mean: "red" and "ball"; and the target may be nowhere
  sum,      ///< their weighted sum, as the paper: "red" or "ball"
};
constexpr std::array<std::string_view, 2> names(Gaze) { return {"product", "sum"}; }

/// How the Task Attention Module reads the mission.
enum class Reader {
  sum,     ///< the sum of the weighted words, as the paper: it does not know their order
  places,  ///< the weighted words, each in its place
  scan,    ///< word by word in both directions: what it learns of two clauses holds for eight
};
constexpr std::array<std::string_view, 3> names(Reader) { return {"sum", "places", "scan"}; }

/// Sizes and readings of the network, named as in the paper; docs/reading.md gives the reasons.
struct Config {
  bool attention = true;              ///< false: the baseline, F = O~
  bool task_attention = false;        ///< the Task Attention Module
  Reader task_reader = Reader::scan;  ///< how it reads the mission
  bool completion_input = false;      ///< c_t goes to the memory, beside the filtered view
  Encoder encoder = Encoder::cell;
  int channels = 16;     ///< C: feature maps of the visual encoding O~
  int word_size = 16;    ///< E: word embedding g~
  int key_size = 16;     ///< d_k
  int memory_size = 64;  ///< LSTM
  int text_size = 32;    ///< GRU over the mission
  int head_size = 64;    ///< hidden layer of actor and of critic
  int task_size = 64;    ///< hidden layer of the Task Attention Module
  int task_words = 32;   ///< outputs of the Task Attention Module: longest mission it takes
  int sub_tasks = 16;    ///< length of the completion vector c_t
  Gaze gaze = Gaze::product;
  double entropy_base = 7;  ///< of the logarithm in the row entropies H (eq. 2)
  double gaze_floor = 0.1;  ///< f: what s(M) leaves of the darkest cells
  double object_prior = 2;  ///< initial score of objects over other cells; 0: none
  // Of the product:
  double sharpness_start = 8;        ///< of the words' maps: their inverse temperature, at first
  double sharpness = 32;             ///< and when the gaze has focused
  double nowhere = 0.68;             ///< score of nowhere, as a share of a word's best match
  double word_choice_start = 2;      ///< slope of the gates between type and color, at first
  double word_choice = 60;           ///< and when the gaze has focused
  double score_cost_start = 2.5e-7;  ///< weight in the loss of what words say, squared, at first
  double score_cost = 2e-8;          ///< and when the gaze has focused
  // Of the sum:
  double gaze_exponent = 2;  ///< p in s(M) = f + (1 - f) (M / max M)^p
  double encoder_bias = 1;   ///< initial bias of the visual encoder: near-linear at the start
  double encoder_leak = 1;   ///< slope of its leaky ReLU below zero; 1: linear, 0: plain ReLU

  static constexpr auto settings() {
    using C = Config;
    return std::tuple{
        Setting{"attention", &C::attention, "text-visual attention; false is the baseline"},
        Setting{"task_attention", &C::task_attention, "the Task Attention Module (mask alpha)"},
        Setting{"task_reader", &C::task_reader,
                "how the module reads the mission: the sum of its weighted words, which does not "
                "know their order; each in its place; or a scan, which composes"},
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
        Setting{"sub_tasks", &C::sub_tasks, "length of the completion vector c_t", 1, 16,
                "clauses"},
        Setting{"gaze", &C::gaze,
                "how the maps of the words become M: their product, which says \"red\" and "
                "\"ball\" and can say nowhere, or the paper's sum"},
        Setting{"entropy_base", &C::entropy_base,
                "base of the logarithm in the row entropies (eq. 2): the larger, the more even the "
                "weights",
                1.1, 1e6},
        Setting{"gaze_floor", &C::gaze_floor,
                "f: what s(M) leaves of the darkest cells; 0: nothing", 0, 1},
        Setting{"object_prior", &C::object_prior,
                "initial score of objects over other cells; 0 switches it off", 0, 16},
        Setting{"sharpness_start", &C::sharpness_start,
                "product: inverse temperature of the words' maps at the start", 0, 1e3},
        Setting{"sharpness", &C::sharpness, "product: and when the gaze has focused", 0, 1e3},
        Setting{"nowhere", &C::nowhere,
                "product: score of nowhere, as a share of what a word scores on its best match", 0,
                1},
        Setting{"word_choice_start", &C::word_choice_start,
                "product: slope of the gates by which a word speaks of type or of color, at the "
                "start; 0: of both alike",
                0, 1e3},
        Setting{"word_choice", &C::word_choice, "product: and when the gaze has focused", 0, 1e3},
        Setting{"score_cost_start", &C::score_cost_start,
                "product: weight in the loss of all that words could say, squared, at the start", 0,
                1},
        Setting{"score_cost", &C::score_cost, "product: and when the gaze has focused", 0, 1},
        Setting{"gaze_exponent", &C::gaze_exponent, "sum: p in s(M) = f + (1 - f) (M / max M)^p", 1,
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

/// From its value at the start to the one at full focus, by equal factors.
inline double focused(double start, double end, double focus) {
  return start > 0 && end > 0 ? start * std::pow(end / start, focus) : focus < 1 ? start : end;
}

/// The Task Attention Module reads the mission once for each completion vector, apart from the
/// view.
inline bool scans(const Config& c) { return c.task_attention && c.task_reader == Reader::scan; }
/// Words of the longest mission that the module takes.
inline int mask_words(const Config& c) {
  return c.task_reader == Reader::scan ? babyai::kMaxMissionWords : c.task_words;
}
/// Numbers that are made once a mission: the text feature, and the mask under it where it is read
/// with the mission.
inline int mission_features(const Config& c) {
  return c.text_size + (scans(c) ? mask_words(c) : 0);
}

/// Throws std::invalid_argument where settings contradict each other.
inline void validate(const Config& c) {
  require(c.attention || !c.task_attention,
          "model: task_attention = true masks word weights, so it needs attention = true (it is "
          "false); set model.attention=true or model.task_attention=false");
  require(!c.attention || c.gaze == Gaze::sum || c.encoder == Encoder::cell,
          "model: gaze = \"product\" asks what a word says of each kind of cell, and encoder = "
          "\"3x3\" knows no kinds; set model.gaze=sum or model.encoder=1x1");
  require(c.word_choice >= c.word_choice_start,
          "model: word_choice = {} is less than word_choice_start = {}; a word that has chosen "
          "does not choose again",
          c.word_choice, c.word_choice_start);
  require(c.sharpness >= c.sharpness_start,
          "model: sharpness = {} is less than sharpness_start = {}; the gaze focuses, it does not "
          "blur",
          c.sharpness, c.sharpness_start);
}

}  // namespace wordgaze::model
