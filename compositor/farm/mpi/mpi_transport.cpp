#include "compositor/farm/mpi/mpi_transport.hpp"

#define OMPI_SKIP_MPICXX 1  // its C++ bindings, which are no part of MPI any more
#include <mpi.h>

#include <array>
#include <deque>
#include <list>
#include <utility>

namespace rs::farm {

// MPI's errors end the whole job, which is its default: without a part of the ranks nothing can go on
// (compositor/farm/README.md).
struct MpiTransport::State {
    int rank = 0;
    int ranks = 1;
    std::array<std::deque<Message>, 2> own;  // [channel] from this rank to itself
    struct Sent {
        std::vector<std::uint8_t> bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    std::list<Sent> sent;  // under way

    void forget_arrived() {
        for (auto at = sent.begin(); at != sent.end();) {
            int arrived = 0;
            MPI_Test(&at->request, &arrived, MPI_STATUS_IGNORE);
            if (arrived == 0) return;  // later ones rarely overtake
            at = sent.erase(at);
        }
    }
};

MpiTransport::MpiTransport() : state_(std::make_unique<State>()) {
    int given = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
    MPI_Comm_rank(MPI_COMM_WORLD, &state_->rank);
    MPI_Comm_size(MPI_COMM_WORLD, &state_->ranks);
}

MpiTransport::~MpiTransport() {
    for (State::Sent& sent : state_->sent) MPI_Wait(&sent.request, MPI_STATUS_IGNORE);
    MPI_Finalize();
}

int MpiTransport::rank() const {
    return state_->rank;
}

int MpiTransport::ranks() const {
    return state_->ranks;
}

MpiTransport::NodePlace MpiTransport::place_on_node() const {
    MPI_Comm node = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, state_->rank, MPI_INFO_NULL, &node);
    NodePlace place;
    MPI_Comm_rank(node, &place.place);
    MPI_Comm_size(node, &place.places);
    MPI_Comm_free(&node);
    return place;
}

void MpiTransport::send(int to, Channel channel, std::vector<std::uint8_t> bytes) {
    if (to == state_->rank) {
        state_->own.at(static_cast<std::size_t>(channel)).push_back({to, std::move(bytes)});
        return;
    }
    state_->forget_arrived();
    State::Sent& sent = state_->sent.emplace_back(State::Sent{std::move(bytes), MPI_REQUEST_NULL});
    MPI_Isend(sent.bytes.data(), static_cast<int>(sent.bytes.size()), MPI_BYTE, to, static_cast<int>(channel),
              MPI_COMM_WORLD, &sent.request);
}

std::optional<Message> MpiTransport::receive(Channel channel) {
    std::deque<Message>& own = state_->own.at(static_cast<std::size_t>(channel));
    if (!own.empty()) {
        Message message = std::move(own.front());
        own.pop_front();
        return message;
    }
    state_->forget_arrived();
    if (state_->ranks == 1) return std::nullopt;
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, static_cast<int>(channel), MPI_COMM_WORLD, &there, &status);
    if (there == 0) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    Message message{status.MPI_SOURCE, std::vector<std::uint8_t>(static_cast<std::size_t>(size))};
    MPI_Recv(message.bytes.data(), size, MPI_BYTE, message.from, static_cast<int>(channel), MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    return message;
}

}  // namespace rs::farm
