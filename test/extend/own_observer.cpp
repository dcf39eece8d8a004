// An own observer: an agent's episodes as lines of text, sent wherever one likes.
#include <cstdio>
#include <string>

#include <wordgaze/evaluation/evaluator.hpp>
#include <wordgaze/policy/environment.hpp>

using namespace wordgaze;

class Lines final : public policy::Observer {
 public:
  int lines = 0, ends = 0;
  bool wants_episode(std::int64_t episode) override { return episode < 3; }
  void on_begin(const policy::EpisodeBegin& begin) override {
    words_ = begin.sentence;
    send(std::string("mission: ").append(begin.mission));
  }
  void on_step(const policy::StepRecord& step) override {
    std::size_t most = 0;
    for (std::size_t i = 0; i < step.word_weights.size(); ++i) {
      if (step.word_weights[i] > step.word_weights[most]) most = i;
    }
    const std::string word(babyai::word(words_.words[most]));
    send("step " + std::to_string(step.step) + ": action " + std::to_string(step.action) +
         ", the word that counts most is '" + word + "'");
  }
  void on_end(const policy::EpisodeEnd& end) override {
    ++ends;
    send(end.success ? "success" : "failure");
  }

 private:
  void send(const std::string& line) {
    ++lines;
    std::puts(line.c_str());
  }
  babyai::Sentence words_;
};

int main() {
  const auto level = babyai::find_level("Wordgaze-One-N5-K2-auto-v0");
  const policy::Agent agent(model::Config{}, policy::alphabet_of(level));
  core::Rng rng(1);
  const auto weights = agent.make_weights(agent.initialize(rng));
  Lines observer;
  Team team(1);
  const auto result =
      evaluation::evaluate(evaluation::policy_factory(agent, weights),
                           {.level = level, .episodes = 5}, team, {.episodes = &observer});
  return result.episodes == 5 && observer.ends == 3 && observer.lines > 6 ? 0 : 1;
}
