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
  /// From a checkpoint of `train`, or from any of our files of weights, with the cells of the level
  /// that it was trained in; with all cells where that level is not known. Throws
  /// std::runtime_error that names the file and what is wrong with it. In the library
  /// wordgaze::policy; all else of this folder can be used by including it.
  static TrainedAgent load(const std::filesystem::path& path);
  /// The same with an alphabet of one's own: which cells the agent may meet. Weights do not depend
  /// on it, but of the product gaze what words say does: they tell the objects of the alphabet
  /// apart (docs/math.md, A8). With others than in training it looks elsewhere.
  static TrainedAgent load(const std::filesystem::path& path, const model::CellAlphabet& alphabet);
};

}  // namespace wordgaze::policy
