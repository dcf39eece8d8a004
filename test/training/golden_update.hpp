#pragma once
#include <string>
#include <vector>

#include "model/golden_agent.hpp"
#include "wordgaze/training/gae.hpp"
#include "wordgaze/training/trainer.hpp"

/// Updates of PyTorch from a rollout that it has drawn (scripts/golden/update.py), and learners in
/// either precision to hold against them.
namespace wordgaze::test {

struct GoldenUpdate {
  Json json;
  model::Config model;
  training::PpoConfig ppo;

  explicit GoldenUpdate(const std::string& name)
      : json(golden("training/update_" + name + ".json")), model(config_of(json.at("config"))) {
    const Json& j = json.at("ppo");
    ppo = {.lanes = j.at("lanes"),
           .steps = j.at("steps"),
           .chunk = j.at("chunk"),
           .epochs = j.at("epochs"),
           .minibatches = j.at("minibatches"),
           .discount = j.at("discount"),
           .gae_lambda = j.at("gae_lambda"),
           .clip = j.at("clip"),
           .value_coefficient = j.at("value_coefficient"),
           .gradient_norm = j.at("gradient_norm"),
           .advantage_floor = j.at("advantage_floor"),
           .mask_coefficient = j.at("mask_coefficient")};
  }

  training::Rates rates(std::size_t update) const {
    const Json& j = json.at("rates").at(update);
    return {j.at("learning_rate"), j.at("task_learning_rate"), j.at("entropy_coefficient")};
  }

  /// What was seen and done, and our advantages of it.
  training::Rollout rollout() const {
    training::Rollout r(model, ppo);
    const Json& from = json.at("rollout");
    for (Index lane = 0; lane < r.shape.batch; ++lane) {
      const auto b = static_cast<std::size_t>(lane);
      for (std::size_t m = 0; m < json.at("missions").size(); ++m) {
        r.missions[b].push_back(mission(m));
      }
      r.next_value[b] = from.at("next_value").at(b);
      for (Index t = 0; t < r.shape.steps; ++t) read_frame(from, lane, t, r);
    }
    for (int s = 0; s < r.sequences(); ++s) {
      const Json& start = from.at("starts")
                              .at(static_cast<std::size_t>(s / r.shape.batch))
                              .at(static_cast<std::size_t>(r.lane(s)));
      r.start_h.col(s) = column(start.at("h")).cast<float>();
      r.start_c.col(s) = column(start.at("c")).cast<float>();
    }
    training::estimate_advantages(r.shape, r.reward, r.value, r.ended, r.next_value,
                                  static_cast<float>(ppo.discount),
                                  static_cast<float>(ppo.gae_lambda), r.advantage);
    return r;
  }

  core::Rng shuffler() const { return core::Rng(json.at("seed").get<std::uint64_t>()); }

 private:
  babyai::Sentence mission(std::size_t number) const {
    babyai::Sentence sentence;
    const Json &words = json.at("missions").at(number), &of = json.at("sub_task_of").at(number);
    for (std::size_t i = 0; i < words.size(); ++i) sentence.append(words.at(i), of.at(i));
    return sentence;
  }
  void read_frame(const Json& from, Index lane, Index t, training::Rollout& r) const {
    const Index column_of = r.shape.column(t, lane);
    const auto n = static_cast<std::size_t>(column_of);
    const auto at = [&](const char* name) -> const Json& {
      return from.at(name).at(static_cast<std::size_t>(lane)).at(static_cast<std::size_t>(t));
    };
    const Json& frame = at("frames");
    for (Index cell = 0; cell < grid::kViewCells; ++cell) {
      r.cells(cell, column_of) = frame.at("codes").at(static_cast<std::size_t>(cell));
    }
    r.mission_of[n] = frame.at("mission");
    r.keep(0, column_of) = frame.at("keep");
    r.completion.col(column_of) = column(frame.at("completion")).cast<float>();
    r.action[n] = at("action");
    r.ended[n] = at("ended");
    r.bright[n] = at("bright");
    r.log_prob[n] = at("log_prob");
    r.value[n] = at("value");
    r.reward[n] = at("reward");
  }
};

/// A learner with the weights of a golden file, in the precision S.
template <class S>
struct GoldenLearner {
  using Agent = model::Agent<S>;
  using Learner = training::Learner<Agent>;
  Agent agent;
  training::PpoConfig ppo;
  Team team;
  typename Agent::Params before;
  Learner learner;

  explicit GoldenLearner(const GoldenUpdate& golden, int workers = 1)
      : agent(golden.model, model::CellAlphabet::one_room()),
        ppo(golden.ppo),
        team(workers),
        before(parameters(agent, golden.json.at("parameters"))),
        learner(agent, ppo, training::make_losses<S>(golden.model, ppo), before, team) {}

  static typename Agent::Params parameters(const Agent& agent, const Json& lists) {
    auto params = agent.make_params();
    read_parameters(lists, params);
    return params;
  }
};

}  // namespace wordgaze::test

/// Compiled once for all tests, in update_test.cpp.
extern template struct wordgaze::model::Agent<double>;
extern template class wordgaze::training::Learner<wordgaze::model::Agent<double>>;
