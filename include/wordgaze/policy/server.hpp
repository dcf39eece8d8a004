#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/core/recent_map.hpp"
#include "wordgaze/grid/observation.hpp"
#include "wordgaze/policy/attention_record.hpp"
#include "wordgaze/policy/policy.hpp"

namespace wordgaze::policy {

/// A robot asks for an action. `sequence` grows from request to request of a client; a request that
/// is sent again keeps its number.
struct Request {
  std::int64_t client = 0, sequence = 0;
  bool reset = false;     ///< an episode begins: empty memory
  std::string mission{};  ///< in words of the vocabulary, as "go to the red ball"
  std::array<std::uint8_t, grid::kImageBytes> image{};  ///< the view, as in Observation
  int direction = -1;  ///< 0 right, 1 down, 2 left, 3 up; -1: not known. The agent does not read it
  std::vector<std::uint8_t> completion{};  ///< c_t: 0 or 1 a sub-task; none: nothing is done yet

  bool operator==(const Request&) const = default;
};

/// The answer. With an error there is no action, and the memory of the client is as it was.
struct Reply {
  std::int64_t client = 0, sequence = 0;
  std::string error{};                        ///< printable ASCII; empty when all is well
  int action = -1;                            ///< grid::Action
  std::vector<float> probabilities{};         ///< one an action
  float value = 0;                            ///< what the critic expects
  babyai::Sentence sentence{};                ///< the mission as the agent reads it
  std::vector<float> word_weights{};          ///< w, one a word; empty without attention
  std::vector<float> word_mask{};             ///< alpha, one a word
  std::array<float, grid::kViewCells> map{};  ///< M
  float nowhere = 0;                          ///< what M has on nowhere

  bool operator==(const Reply&) const = default;
};

/// Decides for many clients that ask over a network which loses, repeats and reorders: each number
/// of a client is answered once, and the same request again has the same answer and moves nothing.
/// Each client has a memory of its own; when there are more clients than room, the one that was
/// silent the longest loses its memory, is told so at its next request, and has to reset.
///
/// It knows no transport and throws nothing but std::bad_alloc. Not for several threads.
class Server {
 public:
  static constexpr std::size_t kMissionCharacters = 1000;  ///< at most

  struct Options {
    std::size_t clients = 64;  ///< with a memory, at most
    bool greedy = false;       ///< the likeliest action; else drawn from the policy
    /// Of the draws: one depends on it, on the client and on the sequence number alone.
    std::uint64_t seed = 1;
  };

  struct Counts {
    std::int64_t requests = 0;   ///< all
    std::int64_t repeats = 0;    ///< that were answered before
    std::int64_t errors = 0;     ///< that were answered by an error; repeats of them are repeats
    std::int64_t clients = 0;    ///< that have begun an episode; an evicted one is counted once
    std::int64_t evictions = 0;  ///< memories that were given up
  };

  /// Asks the first lane of `policy`, which is to be nobody else's and must outlive it. Throws
  /// std::invalid_argument when there is to be room for no client.
  Server(Policy& policy, const Options& options);

  /// Valid until the next call.
  const Reply& answer(const Request& request);

  const Counts& counts() const { return counts_; }
  /// Clients that have a memory now.
  std::size_t clients() const { return clients_.size(); }

 private:
  struct Client {
    Request last;           // that was answered
    Reply reply;            // to it
    Policy::Memory memory;  // after it
  };

  Client decide(const Request& request);
  void observe(const Request& request);
  Reply error(const Request& request, std::string_view what);
  const Reply& refuse(const Request& request, std::string_view what);
  const Reply& remember(Client client);

  Policy* policy_;
  Options options_;
  Counts counts_;
  RecentMap<std::int64_t, Client> clients_;
  RecentMap<std::int64_t, std::int64_t> evicted_;  // the last number of each
  Reply refusal_;
  Observation observation_;
  AttentionRecord attention_;
};

}  // namespace wordgaze::policy
