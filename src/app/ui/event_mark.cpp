#include <app/ui/event_mark.h>
#include <explain/query_progress.h>

namespace mobbscope::app {

EventMark mark_of(mobb::TestKind test, mobb::Outcome outcome) {
    switch (outcome) {
        case mobb::Outcome::disjoint_in_time:
            return EventMark::apart_in_time;
        case mobb::Outcome::separated:
            return EventMark::separated;
        case mobb::Outcome::hit:
            return EventMark::hit;
        case mobb::Outcome::no_hit:
            return EventMark::no_hit;
        case mobb::Outcome::overlap:
            break;
    }
    return test == mobb::TestKind::time ? EventMark::shares_time : EventMark::overlap;
}

BoxState state_of(EventMark mark) {
    switch (mark) {
        case EventMark::apart_in_time:
            return BoxState::apart_in_time;
        case EventMark::separated:
            return BoxState::separated;
        case EventMark::overlap:
        case EventMark::no_hit:
            return BoxState::overlap;
        case EventMark::hit:
            return BoxState::hit;
        case EventMark::shares_time:
            break;
    }
    return BoxState::under_test;
}

const char* headline(EventMark mark) {
    switch (mark) {
        case EventMark::shares_time:
            return "They share time";
        case EventMark::apart_in_time:
            return "Apart in time";
        case EventMark::separated:
            return "Separated in space";
        case EventMark::overlap:
            return "Boxes overlap";
        case EventMark::no_hit:
            return "No hit in these samples";
        case EventMark::hit:
            break;
    }
    return "Hit";
}

}  // namespace mobbscope::app
