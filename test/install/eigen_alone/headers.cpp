// nn, model and policy from headers alone: nothing of the library is linked.
#include <cmath>
#include <cstdio>

#include <wordgaze/policy/network_policy.hpp>

int main() {
  using namespace wordgaze;
  const model::Agent<float> agent(model::Config{}, model::CellAlphabet::one_room());
  auto weights = agent.make_weights();
  weights.params.actor.output.bias(2) = 1;  // 'forward', whatever it sees
  agent.refresh(weights);
  policy::NetworkPolicy policy(agent, weights);
  policy::Observation seen;
  seen.sentence = babyai::sentence_of("go to the red ball");
  policy.observe(0, seen);
  const auto decision = policy.decide(policy::Greedy{})[0];
  std::printf("action %zu, probability %.2f\n", decision.action,
              std::exp(static_cast<double>(decision.log_prob)));
  return decision.as_action() == grid::Action::forward ? 0 : 1;
}
