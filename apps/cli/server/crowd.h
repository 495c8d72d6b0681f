// Chooses the connection to drop when a server is full. Independent of sockets.
#pragma once

#include <array>
#include <cstddef>
#include <list>
#include <optional>

namespace bihive::cli {

/// The connections of a server, each in one of three groups, and in the order in which they last moved.
class Crowd {
 public:
  enum Group : std::size_t {
    kSilent,    ///< no whole request has come yet, or none will
    kResting,   ///< a request was answered, and the next may come
    kAnswered,  ///< an answer is on its way
    kGroups
  };

  class Member {
   public:
    Member() = default;
    virtual ~Member() = default;
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;
    /// Ends the connection, after its removal from the crowd.
    virtual void drop() = 0;

   private:
    friend class Crowd;
    std::optional<Group> group_;
    std::list<Member*>::iterator position_;
  };

  std::size_t size() const;

  /// Adds the member, moves it within its group (it has taken some of its answer), or to another group.
  void move(Member& member, Group group);
  void leave(Member& member);

  /// Drops the longest inactive member of the largest group: so silent clients yield to active ones, and slow readers
  /// to fast ones. False: there is none.
  bool drop_one();

 private:
  std::array<std::list<Member*>, kGroups> groups_;
};

}  // namespace bihive::cli
