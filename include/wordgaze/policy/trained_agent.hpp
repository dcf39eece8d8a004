#pragma once
#include <filesystem>

#include "wordgaze/model/agent.hpp"

namespace wordgaze::policy {

/// An agent with its weights: all that acting needs.
template <class Agent_>
struct BasicTrainedAgent {
  using Agent = Agent_;
  Agent agent;  ///< config and alphabet
  typename Agent::Weights weights;
};

/// The network of the library.
using Agent = model::Agent<float>;

struct TrainedAgent : BasicTrainedAgent<Agent> {
  /// From a checkpoint of `train`, or from any of our files of weights. The alphabet decides which
  /// cells it may meet: weights do not depend on it, and fewer codes are faster. Throws
  /// std::runtime_error that names the file and what is wrong with it. In the library
  /// wordgaze::policy; all else of this folder can be used by including it.
  static TrainedAgent load(const std::filesystem::path& path,
                           const model::CellAlphabet& alphabet = model::CellAlphabet::everything());
};

}  // namespace wordgaze::policy
