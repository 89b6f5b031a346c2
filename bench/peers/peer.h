/// Other libraries that answer the same queries, each as its users would ask it.
#pragma once

#include <mobb/query.h>
#include <paper_tables/random_queries.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mobbscope::bench {

/// A way to answer queries between given clips.
class Peer {
  public:
    virtual ~Peer() = default;

    /// Takes these queries as the next ones. Not timed: everybody has placements at hand in a form of his own.
    virtual void place(std::span<const WorkloadQuery> queries) = 0;
    /// answers[i]: do the two of query i ever collide? As many as there are queries.
    virtual void ask(std::span<char> answers) = 0;
};

struct NamedPeer {
    std::string name;
    std::unique_ptr<Peer> peer;
};

using Clips = std::vector<mobb::ClipPtr>;

/// Each with boxes around so many samples. Defined where the library is there.
std::unique_ptr<Peer> bullet_peer(const Clips& clips, int samples_a_box);
std::unique_ptr<Peer> fcl_peer(const Clips& clips, int samples_a_box);
std::unique_ptr<Peer> embree_peer(const Clips& clips, int samples_a_box);
std::unique_ptr<Peer> boost_peer(const Clips& clips, int samples_a_box);

}  // namespace mobbscope::bench
