#include "app/controller_report.h"

#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace ringhook {
namespace {

nlohmann::ordered_json jsonOf(const std::map<rx60::MessageType, std::int64_t>& messages) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [type, count] : messages) {
    json[rx60::nameOf(type)] = count;
  }
  return json;
}

void printMessages(const char* verb, const std::map<rx60::MessageType, std::int64_t>& messages) {
  for (const auto& [type, count] : messages) {
    printCount(std::string(verb) + " " + rx60::nameOf(type), count);
  }
}

}  // namespace

void sayEvent(Time now, const std::string& what) {
  std::fprintf(stderr, "%9.3f s  %s\n", now.seconds(), what.c_str());
}

void sayWhere(const Rx60Server& server, const std::string& address) {
  std::string ports;
  for (const Rx60Socket socket : kRx60Sockets) {
    ports += (ports.empty() ? "" : ", ") + std::string(nameOf(socket)) + " " +
             std::to_string(server.port(socket));
  }
  std::fprintf(stderr, "simulated RX60 controller listens on %s, ports %s\n", address.c_str(),
               ports.c_str());
}

nlohmann::ordered_json controllerJson(const Rx60Counts& counts, std::int64_t late_ticks) {
  nlohmann::ordered_json json;
  json["ticks"] = counts.ticks;
  json["tick_s"] = Rx60Controller::kTick;
  json["late_ticks"] = late_ticks;
  json["velocity_ticks"] = counts.velocity_ticks;
  json["missed_ticks"] = counts.missed_ticks;
  json["zero_ticks"] = counts.zero_ticks;
  json["received"] = jsonOf(counts.received);
  json["sent"] = jsonOf(counts.sent);
  json["refused"] = counts.refused;
  json["flushes"] = counts.flushes;
  json["travel_rad"] = counts.travel;
  return json;
}

void printCount(const std::string& what, std::int64_t count) {
  std::printf("%-42s %10lld\n", what.c_str(), static_cast<long long>(count));
}

void printController(const Rx60Counts& counts, std::int64_t late_ticks) {
  printCount("controller ticks of 4 ms", counts.ticks);
  printCount("ticks left out, this host was late", late_ticks);
  printCount("ticks in velocity mode", counts.velocity_ticks);
  printCount("of these without a command (missed)", counts.missed_ticks);
  printCount("of these with zero velocity", counts.zero_ticks);
  printMessages("received", counts.received);
  printMessages("sent", counts.sent);
  printCount("refused messages", counts.refused);
  printCount("flushes of unknown input", counts.flushes);
  std::printf("%-42s %10.4f rad\n", "way of the joint that moved most", counts.travel);
}

}  // namespace ringhook
