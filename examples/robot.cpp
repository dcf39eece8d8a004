// A robot that asks `wordgaze serve` what to do, with LCM and the message types alone:
//
//   mkdir -p types && lcm-gen --cpp --cpp-hpath types lcmtypes/policy_*.lcm
//   g++ -std=c++17 -I types examples/robot.cpp -llcm -o robot && ./robot
#include <chrono>
#include <cstdio>
#include <string>

#include <lcm/lcm-cpp.hpp>

#include "wordgaze/policy_reply_t.hpp"
#include "wordgaze/policy_request_t.hpp"

struct Client {
  lcm::LCM bus;
  wordgaze::policy_request_t request{};
  wordgaze::policy_reply_t reply{};

  Client(const std::string& url, const std::string& mission) : bus(url) {
    if (bus.good()) bus.subscribe("WORDGAZE_POLICY_REPLY", &Client::hear, this);
    request.client_id = std::chrono::system_clock::now().time_since_epoch().count();
    request.mission = mission;
    request.direction = -1;  // no compass
  }
  void hear(const lcm::ReceiveBuffer*, const std::string&, const wordgaze::policy_reply_t* heard) {
    if (heard->client_id == request.client_id) reply = *heard;
  }
  /// Asks under the next number, and again under the same one where nothing comes back.
  bool ask(bool reset) {
    request.reset = reset;
    ++request.seq;
    for (int attempt = 0; attempt < 10 && bus.good(); ++attempt) {
      bus.publish("WORDGAZE_POLICY_REQUEST", &request);
      while (reply.seq != request.seq && bus.handleTimeout(200) > 0) {
      }
      if (reply.seq == request.seq) return true;
    }
    reply.error = "nobody answers";
    return false;
  }
};

/// A world to try it in: a floor, and a red ball so many cells to the right and ahead.
struct World {
  int right = -2, ahead = 3;

  void see(unsigned char* image) const {
    for (int cell = 0; cell < 49; ++cell) {
      const bool ball = cell / 7 == 3 + right && cell % 7 == 6 - ahead;
      image[3 * cell] = ball ? 6 : 1;
      image[3 * cell + 1] = image[3 * cell + 2] = 0;
    }
  }
  void act(int action) {
    const int r = right, a = ahead;
    if (action == 0) right = a, ahead = -r;  // the world turns the other way
    if (action == 1) right = -a, ahead = r;
    if (action == 2 && !there()) --ahead;  // the ball stands in the way
  }
  bool there() const { return right == 0 && ahead == 1; }
};

int main(int argc, char** argv) {
  Client client(argc > 1 ? argv[1] : "udpm://239.255.76.67:7667?ttl=0",
                argc > 2 ? argv[2] : "go to the red ball");
  const char* names[] = {"left", "right", "forward", "pickup", "drop", "toggle", "done"};
  World world;
  for (int step = 0; step < 30; ++step) {
    world.see(client.request.image);
    if (!client.ask(step == 0) || !client.reply.error.empty()) {
      std::printf("%s\n", client.reply.error.c_str());
      return 1;
    }
    const int action = client.reply.action;
    std::printf("ball %d right, %d ahead: %s\n", world.right, world.ahead, names[action]);
    if (action == 6) return world.there() ? 0 : 1;
    world.act(action);
  }
  return 1;
}
