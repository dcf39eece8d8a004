#include "wordgaze/policy/robot_policy.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "wordgaze/babyai/parser.hpp"
#include "wordgaze/babyai/wording.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/policy/follower.hpp"
#include "wordgaze/policy/network_policy.hpp"

namespace wordgaze::policy {
namespace {

/// The words as they were written, with the sub-tasks of the instruction. Only articles may differ
/// from how the simulator would say it: which is right depends on a world.
babyai::Sentence sentence_of(std::string_view text, const babyai::Instruction& instruction) {
  babyai::Sentence sentence = babyai::sentence_of(text);
  const babyai::Sentence numbered = babyai::wording(instruction, {});
  require(sentence.length == numbered.length, "mission '{}' is not written as '{}'", text,
          babyai::text(numbered));
  sentence.sub_task_of = numbered.sub_task_of;
  return sentence;
}

int sub_tasks_of(const babyai::Sentence& sentence) {
  const auto& of = sentence.sub_task_of;
  return 1 + *std::max_element(of.begin(), of.begin() + std::max(sentence.length, 1));
}

}  // namespace

struct RobotPolicy::State {
  State(const std::filesystem::path& weights, Options o)
      : trained(TrainedAgent::load(weights)), policy(trained), options(o), rng(o.seed) {}

  bool follows() const { return options.completion != Completion::given; }
  void expect_begun() const {
    if (sub_tasks == 0) throw std::logic_error("RobotPolicy: begin() with a mission comes first");
  }

  /// A view in which nothing is seen tells whether the agent can take the mission in.
  void begin(const babyai::Sentence& sentence, std::optional<Follower> with) {
    const Observation unseen{.sentence = sentence};
    policy.observe(0, unseen);
    policy.begin(0);
    observation = unseen;
    sub_tasks = sub_tasks_of(sentence);
    follower = with;
    last.reset();
  }

  const TrainedAgent trained;
  NetworkPolicy<Agent> policy;
  Options options;
  core::Rng rng;
  Observation observation;
  int sub_tasks = 0;  // of the mission; 0 before the first
  std::optional<Follower> follower;
  std::optional<grid::Action> last;  // of this mission
  AttentionRecord attention;
};

RobotPolicy::RobotPolicy(const std::filesystem::path& weights, Options options)
    : state_(std::make_unique<State>(weights, options)) {}
RobotPolicy::RobotPolicy(RobotPolicy&&) noexcept = default;
RobotPolicy& RobotPolicy::operator=(RobotPolicy&&) noexcept = default;
RobotPolicy::~RobotPolicy() = default;

void RobotPolicy::begin(std::string_view mission) {
  const babyai::Instruction instruction = babyai::parse_mission(mission);
  std::optional<Follower> follower;
  if (state_->follows()) {
    follower.emplace(instruction, state_->options.completion == Completion::declared
                                      ? Follower::Counts::when_declared
                                      : Follower::Counts::when_true);
  }
  state_->begin(policy::sentence_of(mission, instruction), follower);
}

void RobotPolicy::begin(const babyai::Sentence& mission) {
  require(!state_->follows(),
          "RobotPolicy: a mission of single words cannot be followed by views; give its text, or "
          "say yourself what is done (Completion::given)");
  state_->begin(mission, {});
}

Act RobotPolicy::act(std::span<const std::uint8_t, grid::kImageBytes> image) {
  View view;
  std::ranges::copy(image, view.image.begin());
  return act(view);
}

Act RobotPolicy::act(const View& view) {
  State& s = *state_;
  s.expect_begun();
  Observation observation = s.observation;
  observation.image = view.image;
  std::optional<Follower> follower = s.follower;
  if (follower) {
    follower->see(view, s.last);
    observation.completion = follower->completion();
  }
  s.policy.observe(0, observation);  // all that can throw: now nothing does
  s.observation = observation;
  s.follower = follower;

  const Decision decision =
      s.options.greedy ? s.policy.decide(Greedy{})[0] : s.policy.decide(Sampled{s.rng})[0];
  s.last = decision.as_action();
  Act act{.action = decision.as_action(), .value = decision.value};
  nn::Categorical<float>::log_softmax(s.policy.logits(0), act.probabilities);
  for (float& p : act.probabilities) p = std::exp(p);

  s.policy.attention(0, s.attention);
  const AttentionRecord& looked = s.attention;
  std::ranges::copy(looked.gaze, act.gaze.cells.begin());
  act.nowhere = looked.nowhere;
  const babyai::Sentence& sentence = s.observation.sentence;
  for (std::size_t i = 0; i < looked.weights.size(); ++i) {
    auto& word = act.words.emplace_back(Act::Word{.text = babyai::word(sentence.words[i]),
                                                  .sub_task = sentence.sub_task_of[i],
                                                  .weight = looked.weights[i],
                                                  .mask = looked.mask[i]});
    std::copy_n(looked.maps.begin() + static_cast<std::ptrdiff_t>(i * grid::kViewCells),
                grid::kViewCells, word.map.cells.begin());
  }
  return act;
}

void RobotPolicy::did(grid::Action action) {
  state_->expect_begun();
  require(static_cast<int>(action) < grid::kActions, "RobotPolicy: action {}; expected 0 to {}",
          static_cast<int>(action), grid::kActions - 1);
  state_->last = action;
}

int RobotPolicy::sub_tasks() const { return state_->sub_tasks; }

std::span<const std::uint8_t> RobotPolicy::completion() const {
  return std::span(state_->observation.completion)
      .first(static_cast<std::size_t>(state_->sub_tasks));
}

void RobotPolicy::set_done(int sub_task, bool done) {
  State& s = *state_;
  s.expect_begun();
  if (s.follows()) {
    throw std::logic_error(
        "RobotPolicy: what is done is followed by the views; give "
        "Options{.completion = Completion::given} to say it yourself");
  }
  require(sub_task >= 0 && sub_task < s.sub_tasks,
          "RobotPolicy: sub-task {} of '{}'; expected 0 to {}", sub_task,
          babyai::text(s.observation.sentence), s.sub_tasks - 1);
  s.observation.completion[static_cast<std::size_t>(sub_task)] = done;
}

}  // namespace wordgaze::policy
