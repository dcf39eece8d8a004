#include "wordgaze/policy/trained_agent.hpp"

#include <stdexcept>
#include <string>

#include "wordgaze/io/config_file.hpp"
#include "wordgaze/io/parameters.hpp"
#include "wordgaze/io/weights_file.hpp"

namespace wordgaze::policy {

TrainedAgent TrainedAgent::load(const std::filesystem::path& path,
                                const model::CellAlphabet& alphabet) {
  const io::TensorMap map = io::read_weights_file(path);
  try {
    const Agent agent(
        io::parse_section<model::Config>(io::configuration_text(map), "model", "wordgaze.config"),
        alphabet);
    auto params = agent.make_params();
    io::get_parameters(
        map, "", [](const nn::Path&) { return false; }, params);
    return {{agent, agent.make_weights(std::move(params))}};
  } catch (const std::exception& error) {
    io::fail_weights_file(path, error.what());
  }
}

}  // namespace wordgaze::policy
