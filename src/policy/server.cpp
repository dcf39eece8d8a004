#include "wordgaze/policy/server.hpp"
#include "wordgaze/core/types.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <span>
#include <stdexcept>
#include <utility>

#include "wordgaze/babyai/parser.hpp"
#include "wordgaze/core/formatted.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/nn/categorical.hpp"

namespace wordgaze::policy {
namespace {

/// Numbers of clients that have lost their memory, for each that has one.
constexpr std::size_t kEvictedEach = 16;

/// What goes to whoever listens must not trip over what one of them has sent.
std::string printable(std::string_view text) {
  std::string out(text);
  std::ranges::replace_if(
      out, [](char c) { return c < ' ' || c > '~'; }, '?');
  return out;
}

void expect_finite(std::span<const float> numbers) {
  if (std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); })) return;
  throw std::runtime_error(
      "the agent's numbers are not finite: its weights are too large; serve another checkpoint");
}

/// Large requests are not remembered: what a client sends must not fill the memory.
void check_sizes(const Request& request) {
  require(request.mission.size() <= Server::kMissionCharacters,
          "the mission has {} characters; expected at most {}", request.mission.size(),
          Server::kMissionCharacters);
  require(request.completion.size() <= kMaxSubTasks,
          "the completion vector has {} entries; expected at most {}, one for each sub-task of the "
          "mission, or none",
          request.completion.size(), kMaxSubTasks);
}

/// The draw of a request: the same again, whatever other clients ask for.
core::Rng draws(std::uint64_t seed, const Request& request) {
  for (const std::int64_t number : {request.client, request.sequence}) {
    seed = core::Rng(seed ^ static_cast<std::uint64_t>(number)).next64();
  }
  return core::Rng(seed);
}

}  // namespace

Server::Server(Policy& policy, const Options& options)
    : policy_(&policy),
      options_(options),
      clients_(options.clients),
      evicted_(kEvictedEach * options.clients) {}

const Reply& Server::answer(const Request& request) {
  ++counts_.requests;
  const auto is_late = [&](std::int64_t last) {
    return formatted(
        "request {} of client {} comes late: its request {} was answered already; each request has "
        "a larger number than the one before, and a program that is started anew another client_id",
        request.sequence, request.client, last);
  };
  try {
    check_sizes(request);
    Client* client = clients_.find(request.client);
    if (client != nullptr) {
      const std::int64_t last = client->last.sequence;
      if (request.sequence < last) return refuse(request, is_late(last));
      if (request == client->last) {
        ++counts_.repeats;
        return client->reply;
      }
      require(
          request.sequence != last,
          "request {} of client {} is another than the one that was answered under this "
          "number; each request has a number of its own, and each client a client_id of its own",
          last, request.client);
      policy_->set_memory(0, client->memory);
    } else if (const std::int64_t* last = evicted_.find(request.client); last != nullptr) {
      require(request.reset,
              "client {} was evicted: of more than {} clients it was silent the longest, and its "
              "memory was given up; begin an episode, with reset",
              request.client, options_.clients);
      if (request.sequence <= *last) return refuse(request, is_late(*last));
    }
    require(client != nullptr || request.reset,
            "client {} is not known: its first request begins an episode, with reset (the server "
            "may have been started anew)",
            request.client);
    try {
      return remember(decide(request));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& problem) {
      if (client == nullptr) throw;
      client->last = request;
      client->reply = error(request, problem.what());
      return client->reply;
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& problem) {
    return refuse(request, problem.what());
  }
}

Server::Client Server::decide(const Request& request) {
  observe(request);
  if (request.reset) {
    const auto size = policy_->design().config.memory_size;
    policy_->set_memory(0, {true, Vector<float>::Zero(size), Vector<float>::Zero(size)});
  }
  core::Rng rng = draws(options_.seed, request);
  const Decision decision =
      options_.greedy ? policy_->decide(Greedy{})[0] : policy_->decide(Sampled{rng})[0];
  policy_->attention(0, attention_);

  Reply reply{.client = request.client,
              .sequence = request.sequence,
              .action = static_cast<int>(decision.action),
              .value = decision.value,
              .sentence = observation_.sentence,
              .word_weights = attention_.weights,
              .word_mask = attention_.mask,
              .nowhere = attention_.nowhere};
  const auto logits = policy_->logits(0);
  reply.probabilities.resize(logits.size());
  nn::Categorical<float>::log_softmax(logits, reply.probabilities);
  for (float& p : reply.probabilities) p = std::exp(p);
  std::ranges::copy(attention_.gaze, reply.map.begin());

  Client next{request, std::move(reply), policy_->memory(0)};
  for (const auto& memory : {next.memory.h, next.memory.c}) {
    expect_finite({memory.data(), static_cast<std::size_t>(memory.size())});
  }
  for (const auto* numbers :
       {&next.reply.probabilities, &next.reply.word_weights, &next.reply.word_mask}) {
    expect_finite(*numbers);
  }
  expect_finite(next.reply.map);
  expect_finite(std::array{next.reply.value, next.reply.nowhere});
  return next;
}

/// Gives the policy what it is to decide on.
void Server::observe(const Request& request) {
  const auto& codes = policy_->design().alphabet;
  for (std::size_t cell = 0; cell < grid::kViewCells; ++cell) {
    const auto* of = request.image.data() + 3 * cell;
    const bool in_range = of[0] < model::kTypes && of[1] < model::kColors && of[2] < model::kStates;
    require(in_range && codes.find({of[0], of[1], of[2]}) >= 0,
            "cell ({}, {}) of the view is type {}, color {}, state {}, which is not among the {} "
            "kinds of cells that the agent knows; docs/robot-server.md lists them",
            cell / grid::kViewSize, cell % grid::kViewSize, of[0], of[1], of[2], codes.size());
  }
  require(request.direction >= -1 && request.direction <= 3,
          "direction is {}; expected 0 right, 1 down, 2 left, 3 up, or -1: not known",
          request.direction);
  observation_.image = request.image;
  observation_.sentence = babyai::parse_sentence(request.mission);
  const auto& sentence = observation_.sentence;
  require(sentence.length > 0, "the mission is empty; expected words as 'go to the red ball'");

  const auto& of = sentence.sub_task_of;
  const int sub_tasks = 1 + *std::max_element(of.begin(), of.begin() + sentence.length);
  const auto& done = request.completion;
  require(done.empty() || std::cmp_equal(done.size(), sub_tasks),
          "the completion vector has {} entries, mission '{}' has {} sub-tasks ('put A next to B' "
          "is two); expected one for each, or none",
          done.size(), request.mission, sub_tasks);
  for (const std::uint8_t entry : done) {
    require(entry <= 1, "the completion vector holds {}; expected 1 for what is done, else 0",
            entry);
  }
  observation_.completion = {};
  std::ranges::copy(done, observation_.completion.begin());
  policy_->observe(0, observation_);
}

Reply Server::error(const Request& request, std::string_view what) {
  ++counts_.errors;
  return {.client = request.client, .sequence = request.sequence, .error = printable(what)};
}

/// An answer that nobody remembers.
const Reply& Server::refuse(const Request& request, std::string_view what) {
  return refusal_ = error(request, what);
}

/// A decision becomes what its client has last heard.
const Reply& Server::remember(Client client) {
  const std::int64_t id = client.last.client;
  if (clients_.find(id) == nullptr) {
    if (evicted_.find(id) == nullptr) ++counts_.clients;
    evicted_.erase(id);
  }
  if (const auto evicted = clients_.put(id, std::move(client)); evicted) {
    ++counts_.evictions;
    evicted_.put(evicted->first, evicted->second.last.sequence);
  }
  return clients_.find(id)->reply;
}

}  // namespace wordgaze::policy
