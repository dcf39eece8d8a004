#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "wordgaze/core/require.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/design.hpp"
#include "wordgaze/model/frames.hpp"
#include "wordgaze/model/outputs.hpp"
#include "wordgaze/policy/attention_record.hpp"
#include "wordgaze/policy/decision.hpp"
#include "wordgaze/policy/mission_table.hpp"
#include "wordgaze/policy/observation.hpp"

namespace wordgaze::policy {

/// An agent at work: one decision a call for each of a number of lanes, with the memory in between.
/// Training, evaluation, a server and a robot act through it; it knows no environment.
///
///     policy.begin(0);                              // an episode: the memory is empty
///     policy.observe(0, observation);               // a view, a mission, what is done of it
///     policy.decide(Greedy{})[0].as_action();
///
/// Which network decides is NetworkPolicy's affair (network_policy.hpp). Not for several threads.
class Policy {
 public:
  virtual ~Policy() = default;
  Policy(const Policy&) = delete;
  Policy& operator=(const Policy&) = delete;

  int lanes() const { return static_cast<int>(frames_.shape.batch); }
  const model::Design& design() const { return *design_; }

  /// Starts an episode in a lane: empty memory.
  void begin(int lane) { frames_.keep(0, check(lane)) = 0; }

  /// What a lane sees now. The mission may change at any time. Throws std::invalid_argument, and
  /// changes nothing, for a cell that the alphabet does not know, for a number of actions that the
  /// network does not have, and for a mission of more sub-tasks than the completion vector has
  /// entries, if the agent reads it.
  void observe(int lane, const Observation& observation);

  /// A decision of each lane; sampler(lane, log-probabilities) chooses among the actions that are
  /// possible. The memory goes on with it. Throws std::logic_error while a lane has observed
  /// nothing.
  template <class Sampler>
  std::span<const Decision> decide(Sampler&& sampler) {
    compute();
    for (int lane = 0; lane < lanes(); ++lane) {
      const auto possible = logits(lane);
      std::array<float, grid::kActions> numbers;
      const auto log_probs = std::span(numbers).first(possible.size());
      nn::Categorical<float>::log_softmax(possible, log_probs);
      const std::size_t action = sampler(lane, std::span<const float>(log_probs));
      decisions_[static_cast<std::size_t>(lane)] = {
          .action = action,
          .log_prob = log_probs[action],
          .entropy = nn::Categorical<float>::entropy(log_probs),
          .value = outputs_.values(0, lane)};
    }
    go_on(frames_.start);
    frames_.keep.setOnes();
    return decisions_;
  }
  /// What the critic expects of what the lanes see now; nothing is decided.
  std::span<const float> values() {
    compute();
    return {outputs_.values.data(), static_cast<std::size_t>(lanes())};
  }

  // Of the last decision, until the next observation:
  /// One for each action that is possible.
  std::span<const float> logits(int lane) const {
    return {outputs_.logits.col(lane).data(), actions_[static_cast<std::size_t>(lane)]};
  }
  /// M over the 49 cells; false, and nothing is written, without attention.
  virtual bool gaze(int lane, std::span<float, grid::kViewCells> map) const = 0;
  /// Where a lane looked: maps, weights, mask.
  virtual void attention(int lane, AttentionRecord& record) const = 0;
  /// The policies [7, N] of a lane had it seen these N views, a column of 49 codes each, in place
  /// of its own; 0 for actions that are not possible. Mission, completion vector and memory are
  /// those of the decision.
  virtual Matrix<float> policies_for(int lane, const model::CellMatrix& views) = 0;
  /// The same, had it been told one of these N missions now in place of its own.
  virtual Matrix<float> policies_for(int lane, std::span<const babyai::Sentence> missions) = 0;
  /// How the logit of an action depends on each cell of the view as it reaches the memory, F_c [C];
  /// without attention that is the visual encoding itself.
  struct Saliency {
    Vector<float> gradient;  ///< [49] length of d logit / d F_c
    Vector<float> product;   ///< [49] |F_c . d logit / d F_c|: gradient times input
  };
  virtual Saliency saliency(int lane, std::size_t action) = 0;

  // For whoever trains the network:

  /// The weights have changed. Lanes keep their memory and missions.
  void refresh();
  /// What the next decision is made from; columns are lanes.
  const model::Frames<float>& frames() const { return frames_; }
  const babyai::Sentence& sentence(int lane) const { return missions_[frames_.mission(lane)]; }

  /// What a lane carries from one decision to the next.
  struct Memory {
    bool begins = true;  ///< an episode, with the next decision
    Vector<float> h, c;  ///< [H] output and cell of the LSTM
  };
  Memory memory(int lane) const;
  void set_memory(int lane, const Memory& memory);

  /// Keeps what a lane sees now, of an episode that time cuts off, to be valued with others of its
  /// kind: kept_values() gives one number for each keep() in their order, and forgets them.
  void keep(int lane);
  std::span<const float> kept_values();

 protected:
  Policy(const model::Design& design, int lanes);

  /// Which scratch a computation uses: that of decisions stays as it is for questions about them.
  enum class Use : std::uint8_t { decisions, kept };

  /// Text features of missions, into the first columns of `text` [G, size or more].
  virtual void encode_text(const model::Missions& missions, Matrix<float>& text) = 0;
  virtual void forward(Use use, const model::Frames<float>& frames,
                       model::Outputs<float>& outputs) = 0;
  /// The memory after the last forward of decisions.
  virtual void go_on(nn::Lstm<float>::State& memory) const = 0;

  const model::Missions& missions() const { return missions_.missions(); }
  const Matrix<float>& text() const { return text_; }

 private:
  static constexpr int kNoMission = -1;
  /// What keep() has kept of a lane.
  struct Kept {
    int mission;
    Eigen::Matrix<std::uint8_t, grid::kViewCells, 1> cells;
    Vector<float> completion, h, c;
  };

  int check(int lane) const;
  void check_mission(const babyai::Sentence& sentence) const;
  void encode_fresh_missions();
  void compute();

  const model::Design* design_;
  model::Frames<float> frames_;  // one step; mission_of are slots of missions_
  MissionTable missions_;
  Matrix<float> text_;  // [G, slots or more]
  model::Missions fresh_missions_;
  Matrix<float> fresh_text_;
  model::Outputs<float> outputs_;
  std::vector<std::size_t> actions_;  // that are possible, a number a lane
  std::vector<Decision> decisions_;
  std::vector<Kept> kept_;
  std::size_t kept_count_ = 0;  // of kept_ in use; the rest keep their memory
  model::Frames<float> kept_frames_;
  model::Outputs<float> kept_outputs_;
  std::vector<float> kept_values_;
};

inline Policy::Policy(const model::Design& design, int lanes)
    : design_(&design), missions_(4 * lanes + 64) {
  require(lanes > 0, "Policy: needs at least one lane, got {}", lanes);
  frames_.resize(design.config, {1, lanes});
  frames_.mission_of.assign(static_cast<std::size_t>(lanes), kNoMission);
  kept_frames_.resize(design.config, {1, lanes});
  actions_.assign(static_cast<std::size_t>(lanes), grid::kActions);
  decisions_.resize(static_cast<std::size_t>(lanes));
}

inline int Policy::check(int lane) const {
  require(lane >= 0 && lane < lanes(), "Policy: lane {} of {}", lane, lanes());
  return lane;
}

inline void Policy::check_mission(const babyai::Sentence& sentence) const {
  const model::Config& config = design_->config;
  const auto& of = sentence.sub_task_of;
  const int sub_tasks = 1 + *std::max_element(of.begin(), of.begin() + sentence.length);
  require(
      !(config.task_attention || config.completion_input) || sub_tasks <= config.sub_tasks,
      "mission '{}' has {} sub-tasks, the completion vector of the agent {}; train with a larger "
      "model.sub_tasks",
      babyai::text(sentence), sub_tasks, config.sub_tasks);
  require(!config.task_attention || sentence.length <= model::mask_words(config),
          "mission '{}' has {} words, the Task Attention Module takes {}; train with a larger "
          "model.task_words",
          babyai::text(sentence), sentence.length, model::mask_words(config));
}

inline void Policy::observe(int lane, const Observation& observation) {
  int& mission = frames_.mission_of[static_cast<std::size_t>(check(lane))];
  model::Mission wanted{observation.sentence, {}};
  if (model::scans(design_->config)) wanted.done = observation.completion;
  require(observation.actions >= 1 && observation.actions <= grid::kActions,
          "Policy: {} actions; expected 1 to {}", observation.actions, grid::kActions);
  const bool another = mission == kNoMission || missions_[mission] != wanted;
  if (another) check_mission(observation.sentence);
  std::array<std::uint8_t, grid::kViewCells> cells;
  design_->alphabet.encode(observation.image, cells);
  if (another) {
    if (mission != kNoMission) missions_.release(mission);
    mission = missions_.acquire(wanted);
  }
  actions_[static_cast<std::size_t>(lane)] = static_cast<std::size_t>(observation.actions);
  std::copy(cells.begin(), cells.end(), frames_.cells.col(lane).data());
  auto completion = frames_.completion.col(lane);
  for (Index i = 0; i < completion.size(); ++i) {
    completion(i) = observation.completion[static_cast<std::size_t>(i)];
  }
}

inline void Policy::encode_fresh_missions() {
  if (missions_.fresh().empty()) return;
  fresh_missions_.clear();
  for (const int slot : missions_.fresh()) fresh_missions_.index_of(missions_[slot]);
  const Index size = model::mission_features(design_->config), fresh = fresh_missions_.size();
  if (fresh_text_.cols() < fresh) fresh_text_.resize(size, fresh);
  encode_text(fresh_missions_, fresh_text_);
  if (text_.cols() < missions().size()) {
    text_.conservativeResize(size, std::max<Index>(2 * text_.cols(), missions().size()));
  }
  Index column = 0;
  for (const int slot : missions_.fresh()) text_.col(slot) = fresh_text_.col(column++);
  missions_.all_encoded();
}

inline void Policy::compute() {
  for (int lane = 0; lane < lanes(); ++lane) {
    if (frames_.mission(lane) == kNoMission) {
      throw std::logic_error("Policy: a decision of a lane that has observed nothing yet");
    }
  }
  encode_fresh_missions();
  forward(Use::decisions, frames_, outputs_);
}

inline void Policy::refresh() {
  const MissionTable old = std::move(missions_);
  missions_ = MissionTable(4 * lanes() + 64);
  for (int& mission : frames_.mission_of) {
    if (mission != kNoMission) mission = missions_.acquire(old[mission]);
  }
  kept_count_ = 0;
}

inline Policy::Memory Policy::memory(int lane) const {
  return {.begins = frames_.keep(0, check(lane)) == 0,
          .h = frames_.start.h.col(lane),
          .c = frames_.start.c.col(lane)};
}

inline void Policy::set_memory(int lane, const Memory& memory) {
  frames_.keep(0, check(lane)) = memory.begins ? 0.0f : 1.0f;
  frames_.start.h.col(lane) = memory.h;
  frames_.start.c.col(lane) = memory.c;
}

inline void Policy::keep(int lane) {
  if (kept_count_ == kept_.size()) kept_.emplace_back();
  Kept& kept = kept_[kept_count_++];
  kept.mission = missions_.acquire(missions_[frames_.mission(check(lane))]);
  kept.cells = frames_.cells.col(lane);
  kept.completion = frames_.completion.col(lane);
  kept.h = frames_.start.h.col(lane);
  kept.c = frames_.start.c.col(lane);
}

inline std::span<const float> Policy::kept_values() {
  encode_fresh_missions();
  kept_values_.clear();
  const auto batch = static_cast<std::size_t>(lanes());
  // Columns that are left over run along; what they held may be of missions that are gone.
  std::fill(kept_frames_.mission_of.begin(), kept_frames_.mission_of.end(), 0);
  for (std::size_t from = 0; from < kept_count_; from += batch) {
    const std::size_t size = std::min(batch, kept_count_ - from);
    for (std::size_t i = 0; i < size; ++i) {
      const Kept& kept = kept_[from + i];
      const auto column = static_cast<Index>(i);
      kept_frames_.mission_of[i] = kept.mission;
      kept_frames_.cells.col(column) = kept.cells;
      kept_frames_.completion.col(column) = kept.completion;
      kept_frames_.start.h.col(column) = kept.h;
      kept_frames_.start.c.col(column) = kept.c;
    }
    forward(Use::kept, kept_frames_, kept_outputs_);
    for (std::size_t i = 0; i < size; ++i) {
      kept_values_.push_back(kept_outputs_.values(0, static_cast<Index>(i)));
    }
  }
  for (std::size_t i = 0; i < kept_count_; ++i) missions_.release(kept_[i].mission);
  kept_count_ = 0;
  return kept_values_;
}

}  // namespace wordgaze::policy
