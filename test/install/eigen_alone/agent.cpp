// An agent without training in a room of the simulator.
#include <cstdio>

#include <wordgaze/policy/environment.hpp>

int main() {
  using namespace wordgaze;
  env::Environment room("Wordgaze-One-N8-K4-v0");
  room.reset(1);
  const policy::Agent agent(model::Config{}, policy::alphabet_of(room.spec()));
  core::Rng rng(1);
  const auto weights = agent.make_weights(agent.initialize(rng));
  policy::NetworkPolicy<policy::Agent> acts(agent, weights);
  acts.observe(0, policy::observe(room));
  room.step(acts.decide(policy::Greedy{})[0].as_action());
  std::printf("%s: %d step\n", room.mission().c_str(), room.step_count());
  return room.step_count() == 1 ? 0 : 1;
}
