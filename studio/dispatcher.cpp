// SPDX-License-Identifier: MIT
#include "studio/dispatcher.h"

#include <variant>

#include "studio/answers.h"
#include "studio/gate.h"
#include "studio/proof.h"

namespace carom::studio {

bool Dispatcher::message(SocketId socket, const std::string& text) {
  if (refused_.contains(socket)) return true;
  Command command;
  try {
    command = readCommand(text);
  } catch (const MessageError& error) {
    const bool pointer = error.where().starts_with('/');
    line_.tell(socket, answering(error.re, errorMessage({"bad_message", pointer ? error.message() : error.what(),
                                                         pointer ? error.where() : "", ""})));
    return true;
  }
  const auto known = known_.find(socket);
  const Prove* asks = std::get_if<Prove>(&command.what);
  if (known == known_.end()) return asks ? prove(socket, command.id, asks->nonce) : greet(socket, std::move(command));
  const auto refuse = [&](const std::string& sentence, const char* pointer) {
    line_.tell(socket, answering(command.id, errorMessage({"bad_message", sentence, pointer, ""})));
    return true;
  };
  if (command.id <= known->second)
    return refuse("found " + std::to_string(command.id) + ", expected more than " + std::to_string(known->second) +
                      ", the number of the message before",
                  "/id");
  known->second = command.id;
  if (std::holds_alternative<Hello>(command.what)) return refuse("found a second hello, expected one", "");
  if (asks) return refuse("found prove after hello, expected it before", "");
  return mailbox_.put({socket, std::move(command)});
}

bool Dispatcher::greet(SocketId socket, Command command) {
  const auto refuse = [&](const std::string& sentence, CloseReason reason, std::chrono::milliseconds after) {
    refused_.insert(socket);
    line_.tell(socket, answering(command.id, errorMessage({"unauthorized", sentence, "", ""})));
    line_.close(socket, std::move(reason), after);
    return true;
  };
  const Hello* hello = std::get_if<Hello>(&command.what);
  if (hello == nullptr)
    return refuse("found another message, expected hello first", {4401, "no hello"}, limits_.wrong_token);
  if (!sameToken(hello->token, token_))
    return refuse("found another token; open the address that carom studio printed", {4401, "wrong token"},
                  limits_.wrong_token);
  if (hello->protocol != kProtocol)
    return refuse("found another version of the protocol; load the page again", {4400, "other protocol"},
                  limits_.wrong_token);
  known_[socket] = command.id;
  line_.welcome(socket);
  return mailbox_.put({socket, std::move(command)});
}

bool Dispatcher::prove(SocketId socket, std::int64_t id, const std::string& nonce) {
  if (std::chrono::steady_clock::now() < proves_from_) {
    refused_.insert(socket);
    line_.close(socket, {1013, "no proof yet"}, std::chrono::milliseconds(0));
    return true;
  }
  line_.tell(socket, answering(id, proofMessage(hmacSha256(token_, nonce))));
  return true;
}

void Dispatcher::gone(SocketId socket) {
  refused_.erase(socket);
  if (known_.erase(socket) > 0) mailbox_.put({socket, {0, Gone{}}});
}

}  // namespace carom::studio
