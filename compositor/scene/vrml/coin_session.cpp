#include "compositor/scene/vrml/coin_session.hpp"

#include <Inventor/SoDB.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/fields/SoFields.h>
#include <Inventor/nodes/SoSubNode.h>

#include <algorithm>

namespace rs::compositor::vrml {

// Node classes of our own. Coin takes their names from here.

class RsInline : public SoNode {
    SO_NODE_HEADER(RsInline);

public:
    static void initClass() { SO_NODE_INIT_CLASS(RsInline, SoNode, "Node"); }
    RsInline() {
        SO_NODE_CONSTRUCTOR(RsInline);
        SO_NODE_ADD_EMPTY_MFIELD(url);
        SO_NODE_ADD_FIELD(load, (TRUE));
        SO_NODE_ADD_FIELD(bboxCenter, (0, 0, 0));
        SO_NODE_ADD_FIELD(bboxSize, (-1, -1, -1));
    }
    SoMFString url;
    SoSFBool load;
    SoSFVec3f bboxCenter;
    SoSFVec3f bboxSize;

protected:
    ~RsInline() override = default;
};

class RsRaySpace : public SoNode {
    SO_NODE_HEADER(RsRaySpace);

public:
    static void initClass() { SO_NODE_INIT_CLASS(RsRaySpace, SoNode, "Node"); }
    RsRaySpace() {
        SO_NODE_CONSTRUCTOR(RsRaySpace);
        SO_NODE_ADD_EMPTY_MFIELD(url);
        SO_NODE_ADD_FIELD(size, (1));
        SO_NODE_ADD_FIELD(standing, (TRUE));
        SO_NODE_ADD_FIELD(description, (""));
    }
    SoMFString url;
    SoSFFloat size;
    SoSFBool standing;
    SoSFString description;

protected:
    ~RsRaySpace() override = default;
};

class RsRaySpaceRoom : public SoNode {
    SO_NODE_HEADER(RsRaySpaceRoom);

public:
    static void initClass() { SO_NODE_INIT_CLASS(RsRaySpaceRoom, SoNode, "Node"); }
    RsRaySpaceRoom() {
        SO_NODE_CONSTRUCTOR(RsRaySpaceRoom);
        SO_NODE_ADD_EMPTY_MFIELD(children);
        SO_NODE_ADD_FIELD(bboxCenter, (0, 0, 0));
        SO_NODE_ADD_FIELD(bboxSize, (-1, -1, -1));
        SO_NODE_ADD_FIELD(description, (""));
    }
    SoMFNode children;
    SoSFVec3f bboxCenter;
    SoSFVec3f bboxSize;
    SoSFString description;

protected:
    ~RsRaySpaceRoom() override = default;
};

class RsImageTexture : public SoNode {
    SO_NODE_HEADER(RsImageTexture);

public:
    static void initClass() { SO_NODE_INIT_CLASS(RsImageTexture, SoNode, "Node"); }
    RsImageTexture() {
        SO_NODE_CONSTRUCTOR(RsImageTexture);
        SO_NODE_ADD_EMPTY_MFIELD(url);
        SO_NODE_ADD_FIELD(repeatS, (TRUE));
        SO_NODE_ADD_FIELD(repeatT, (TRUE));
    }
    SoMFString url;
    SoSFBool repeatS;
    SoSFBool repeatT;

protected:
    ~RsImageTexture() override = default;
};

SO_NODE_SOURCE(RsInline)
SO_NODE_SOURCE(RsRaySpace)
SO_NODE_SOURCE(RsRaySpaceRoom)
SO_NODE_SOURCE(RsImageTexture)

namespace {

std::mutex coin_lock;
std::string first_complaint;

void note_error(const SoError* error, void* /*user*/) {
    if (first_complaint.empty()) first_complaint = error->getDebugString().getString();
}

}  // namespace

CoinSession::CoinSession() : lock_(coin_lock) {
    static const bool started = [] {
        SoDB::init();
        SoReadError::setHandlerCallback(note_error, nullptr);
        SoDebugError::setHandlerCallback(note_error, nullptr);
        RsInline::initClass();
        RsRaySpace::initClass();
        RsRaySpaceRoom::initClass();
        RsImageTexture::initClass();
        return true;
    }();
    static_cast<void>(started);
    first_complaint.clear();
}

std::string CoinSession::complaint() {
    std::string line = first_complaint;
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\t' || c == '\r'; }, ' ');
    return line;
}

}  // namespace rs::compositor::vrml
