package wordgaze.spy;

import java.awt.Color;
import java.awt.Dimension;
import java.awt.Font;
import java.awt.Graphics;
import java.awt.event.ActionEvent;
import java.util.LinkedHashMap;
import java.util.Map;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import javax.swing.JInternalFrame;
import javax.swing.JPanel;
import javax.swing.Timer;
import lcm.lcm.LCM;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;
import wordgaze.episode_begin_t;
import wordgaze.policy_reply_t;
import wordgaze.step_t;

/**
 * Draws what an agent sees and where it looks: right-click on the channel of a step_t or a
 * policy_reply_t. The view, M over it, the words with their weights and the mask, the action.
 */
public class GazePlugin implements SpyPlugin {
  private static final String[] ACTIONS = {
    "left", "right", "forward", "pickup", "drop", "toggle", "done"};

  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == step_t.LCM_FINGERPRINT || fingerprint == policy_reply_t.LCM_FINGERPRINT;
  }

  /** Called with nulls too, for the label. */
  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new AbstractAction("Where the agent looks") {
      @Override
      public void actionPerformed(ActionEvent event) {
        JInternalFrame frame = new JInternalFrame(channel.name, true, true, true, true);
        frame.setContentPane(new Drawing(channel));
        frame.pack();
        desktop.add(frame);
        frame.setVisible(true);
      }
    };
  }

  /** What the two messages have in common. */
  private static final class Gaze {
    byte[] image;  // null: the message has none
    float[] map, weights, mask;
    String[] words;
    String text;
  }

  private static final class Drawing extends JPanel {
    private static final int CELL = 40, VIEW = 7 * CELL, LINE = 22, LEFT = 12;
    private static final String SIGNS = "...:DKOB*~";  // of types: door, key, ball, box, goal, lava
    private static final Color[] COLORS = {
      new Color(220, 40, 40), new Color(40, 170, 40), new Color(60, 90, 230),
      new Color(150, 50, 200), new Color(220, 200, 30), new Color(130, 130, 130)};

    private final ChannelData channel;
    private final Map<Long, String[]> missions = new LinkedHashMap<>() {
      @Override
      protected boolean removeEldestEntry(Map.Entry<Long, String[]> eldest) {
        return size() > 100;
      }
    };

    Drawing(ChannelData channel) {
      this.channel = channel;
      setBackground(Color.WHITE);
      setPreferredSize(new Dimension(VIEW + 300, VIEW + 60));
      // A step_t does not say its words: they come with the beginning of its episode.
      LCM.getSingleton().subscribe("WORDGAZE_EPISODE_BEGIN", (lcm, name, in) -> {
        try {
          episode_begin_t begin = new episode_begin_t(in);
          synchronized (missions) {
            missions.put(begin.episode_id, begin.tokens);
          }
        } catch (java.io.IOException damaged) {
          // It is passed over, as the spy does.
        }
      });
      new Timer(50, event -> repaint()).start();
    }

    private Gaze read(Object message) {
      Gaze gaze = new Gaze();
      if (message instanceof step_t) {
        step_t step = (step_t) message;
        gaze.image = step.image;
        gaze.map = step.attention_map;
        gaze.weights = step.word_weights;
        gaze.mask = step.word_mask;
        synchronized (missions) {
          gaze.words = missions.get(step.episode_id);
        }
        gaze.text = "episode " + step.episode_id + ", step " + step.step + ": "
            + action(step.action) + ", value " + step.value;
      } else if (message instanceof policy_reply_t) {
        policy_reply_t reply = (policy_reply_t) message;
        gaze.map = reply.attention_map;
        gaze.weights = reply.word_weights;
        gaze.mask = reply.word_mask;
        gaze.words = reply.tokens;
        gaze.text = "client " + reply.client_id + ", request " + reply.seq + ": "
            + (reply.error.isEmpty()
                ? action(reply.action) + ", value " + reply.value
                : reply.error);
      } else {
        return null;
      }
      return gaze;
    }

    private static String action(int action) {
      return action >= 0 && action < ACTIONS.length ? ACTIONS[action] : "no action";
    }

    @Override
    protected void paintComponent(Graphics g) {
      super.paintComponent(g);
      Gaze gaze = read(channel.last);
      if (gaze == null) return;
      for (int x = 0; x < 7; ++x) {
        for (int y = 0; y < 7; ++y) paintCell(g, gaze, x, y);
      }
      g.setColor(Color.RED);
      int[] xs = {3 * CELL + 10, 4 * CELL - 10, 3 * CELL + CELL / 2};
      int[] ys = {VIEW - 8, VIEW - 8, VIEW - 30};
      g.fillPolygon(xs, ys, 3);  // the agent
      g.setColor(Color.BLACK);
      g.setFont(new Font(Font.SANS_SERIF, Font.PLAIN, 13));
      g.drawString(gaze.text, LEFT, VIEW + 30);
      for (int i = 0; i < gaze.weights.length; ++i) paintWord(g, gaze, i);
    }

    /** The cell in small, in a frame as bright as M: black is 0, orange is 1. */
    private static void paintCell(Graphics g, Gaze gaze, int x, int y) {
      int cell = 7 * x + y;
      float m = Math.max(0, Math.min(1, gaze.map[cell]));
      g.setColor(new Color(Math.round(255 * m), Math.round(150 * m), 0));
      g.fillRect(x * CELL, y * CELL, CELL - 1, CELL - 1);
      if (gaze.image == null) return;
      int type = gaze.image[3 * cell] & 0xFF, color = (gaze.image[3 * cell + 1] & 0xFF) % 6;
      g.setColor(type == 0 ? Color.BLACK : type == 2 ? Color.GRAY : new Color(60, 60, 60));
      g.fillRect(x * CELL + 6, y * CELL + 6, CELL - 13, CELL - 13);
      if (type < 3) return;
      g.setColor(COLORS[color]);
      String sign = type < SIGNS.length() ? SIGNS.substring(type, type + 1) : "?";
      g.setFont(new Font(Font.MONOSPACED, Font.BOLD, 22));
      g.drawString(sign, x * CELL + 13, y * CELL + 27);
    }

    /** A bar as long as the weight; grey where the mask does not let the word through. */
    private static void paintWord(Graphics g, Gaze gaze, int i) {
      int y = LINE * (i + 1);
      float alpha = Math.max(0, Math.min(1, gaze.mask[i]));
      int grey = Math.round(200 * (1 - alpha));
      int red = Math.max(grey, Math.round(255 * alpha));
      g.setColor(new Color(red, Math.max(grey, Math.round(150 * alpha)), grey));
      g.fillRect(VIEW + LEFT + 90, y - 12, Math.round(180 * gaze.weights[i]), 14);
      g.setColor(new Color(grey, grey, grey));
      g.setFont(new Font(Font.SANS_SERIF, Font.PLAIN, 14));
      boolean known = gaze.words != null && i < gaze.words.length;
      g.drawString(known ? gaze.words[i] : "word " + (i + 1), VIEW + LEFT, y);
    }
  }
}
