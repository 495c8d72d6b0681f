// Who has to go when a server is full. Nothing here knows of sockets.
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
    /// Ends the connection. The crowd has let it go before.
    virtual void drop() = 0;

   private:
    friend class Crowd;
    std::optional<Group> group_;
    std::list<Member*>::iterator position_;
  };

  std::size_t size() const;

  /// The member comes, moves within its group (it has taken a part of its answer), or goes to another one.
  void move(Member& member, Group group);
  void leave(Member& member);

  /// Drops the member that has not moved for longest, of the largest group: so those who say nothing make room for
  /// those who do, and those who take an answer slowly for those who take theirs. False: nobody is there.
  bool drop_one();

 private:
  std::array<std::list<Member*>, kGroups> groups_;
};

}  // namespace bihive::cli
